#include "split_mapf/fleet/fleet_replan.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "fleet/fleet_goals.h"
#include "pipeline/mended_rest.h"
#include "search/ring_breaking.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/validate.h"

namespace split_mapf {
namespace {

// Plans that are made to find one without rings.
constexpr std::uint32_t kTriesAtRings = 4;

/// The rows and columns of all vertices, row-major.
std::vector<std::uint32_t> cellsOf(const Grid& grid) {
  std::vector<std::uint32_t> cells(grid.size());
  for (Vertex v = 0; v < grid.size(); ++v) {
    const Cell cell = grid.cellOf(v);
    cells[v] =
        static_cast<std::uint32_t>(cell.y) * grid.width() + static_cast<std::uint32_t>(cell.x);
  }
  return cells;
}

/// One call of answerFleet().
class FleetRun {
 public:
  FleetRun(const FleetQuestion& question, const Deadline& deadline)
      : question_(question), deadline_(deadline) {
    answer_.version = question.version;
    answer_.anew = question.anew;
    answer_.ground = question.ground;
    const Precedence& order = question.graph.precedence();
    for (std::uint32_t robot = 0; robot < order.robots(); ++robot) {
      starts_.push_back(order[question.cut[robot]].vertex);
    }
  }

  FleetAnswer improve() {
    const Precedence& order = question_.graph.precedence();
    std::vector<Vertex> goals;
    for (std::uint32_t robot = 0; robot < order.robots(); ++robot) {
      const bool goes = question_.takes_part[robot];
      goals.push_back(goes ? order[order.last(robot)].vertex : starts_[robot]);
    }
    prepareGround(goals);
    ReplanQuestion rest;
    rest.graph = &question_.graph;
    rest.stands = question_.stands;
    rest.came_from = question_.came_from;
    rest.commit = 0;
    rest.avoid_rings = question_.avoid_rings;
    rest.promised = question_.cut;
    ReplanAnswer found = answer_.ground->replanner.replan(rest, deadline_);
    answer_.rings = found.rings;
    answer_.execution = std::move(found.execution);
    return std::move(answer_);
  }

  FleetAnswer planAnew(const Planner& planner, const PlanRequest& request) {
    starts_.insert(starts_.end(), question_.joiners.begin(), question_.joiners.end());
    std::vector<bool> takes_part = question_.takes_part;
    takes_part.resize(starts_.size(), true);
    const auto open = openPart(question_.grid, question_.blocked, question_.closed_edges);
    answer_.faults.assign(starts_.size(), GoalFault::kNone);
    for (std::size_t given_up = 0; given_up <= starts_.size(); ++given_up) {
      FleetGoals chosen = chooseGoals(*open, question_.blocked, starts_, question_.goals,
                                      takes_part, answer_.faults);
      answer_.faults = std::move(chosen.faults);
      setGround(open, chosen.goals);
      if (tryToMend(open)) break;
      const std::optional<std::uint32_t> hopeless = tryToPlan(planner, request);
      if (!hopeless) break;
      answer_.faults[*hopeless] = GoalFault::kNoWay;
    }
    // Other plans may use all edges.
    if (is_cut_) answer_.ground.reset();
    return std::move(answer_);
  }

 private:
  /// Keeps what can be kept of the plan under execution. @return whether that gave a plan without
  /// rings; others are better planned as a whole.
  bool tryToMend(const std::shared_ptr<const Grid>& open) {
    const Precedence order = restBehind(question_.graph, question_.cut);
    Plan rest = planOf(order, earliestSteps(order));
    trimToArrival(rest);
    for (std::uint32_t tries = 0; tries < kTriesAtRings && mendOnce(rest); ++tries) {
      if (!breaksRings() || rings_.empty()) return true;
      cutRings(tries);
    }
    if (!is_cut_) return false;
    setGround(open, answer_.ground->instance.goals());
    rings_.clear();
    is_cut_ = false;
    return false;
  }

  /// @param rest  becomes a valid plan on the ground as it is. @return whether it could.
  bool mendOnce(Plan& rest) {
    const Instance& instance = answer_.ground->instance;
    const std::vector<std::uint32_t> diverted = findDiverted(instance, rest);
    if (diverted.empty()) {
      // Nobody has to go elsewhere; but if nobody gets on either, the plan is not good.
      rest = keepBest(std::move(rest));
      const bool is_good = rings_.empty() || !breaksRings();
      if (question_.stalled && is_good) answer_.execution.reset();
      return answer_.execution.has_value();
    }
    std::optional<Plan> mended =
        mendRest(instance, std::move(rest), diverted, question_.budget.seed, deadline_);
    if (!mended) return false;
    rest = keepBest(*std::move(mended));
    return true;
  }

  /// Whether a ring would never begin.
  bool breaksRings() const { return question_.avoid_rings && question_.graph.release() > 0; }

  /// @return a robot whose goal nobody can bring it to, where that is why there is no plan.
  std::optional<std::uint32_t> tryToPlan(const Planner& planner, PlanRequest request) {
    request.seed += question_.budget.seed;
    const bool breaks = breaksRings();
    const std::string solver = request.solver;
    for (std::uint32_t tries = 0; tries < (breaks ? kTriesAtRings : 1); ++tries) {
      if (!rings_.empty()) cutRings(tries);
      // Plans of robots that are planned one by one have fewer rings.
      request.solver = tries % 2 == 0 ? solver : "prioritized";
      const PlanReport report = planner.plan(answer_.ground->instance, request, deadline_);
      if (!report.plan) {
        if (answer_.execution) continue;
        answer_.message = report.message.empty() ? toString(report.termination) : report.message;
        if (tries == 0 && report.refusal) return whoGivesUp(*report.refusal);
        continue;
      }
      keepBest(*report.plan);
      if (!breaks || answer_.rings == 0 || deadline_.expired()) break;
      ++request.seed;
    }
    return std::nullopt;
  }

  /// Takes an edge out of the cycle of each ring of the last plan, where no robot can rotate then.
  /// As the edge lies on a cycle, its ends stay connected.
  void cutRings(std::uint32_t number) {
    std::vector<Edge> removed = question_.closed_edges;
    for (const std::vector<Edge>& ring : rings_) {
      removed.push_back(ring[(question_.budget.seed + number) % ring.size()]);
    }
    const std::vector<Vertex> goals = answer_.ground->instance.goals();
    setGround(openPart(question_.grid, question_.blocked, removed), goals);
    is_cut_ = true;
  }

  /// The edges along which robots of each ring rotate.
  static std::vector<std::vector<Edge>> edgesOf(const ExecutionGraph& graph) {
    const Precedence& order = graph.precedence();
    std::vector<std::vector<Edge>> rings;
    for (const Ring& ring : graph.rings()) {
      rings.emplace_back();
      for (const VisitId event : ring) {
        const auto ends = std::minmax(order[event - 1].vertex, order[event].vertex);
        rings.back().emplace_back(ends.first, ends.second);
      }
    }
    return rings;
  }

  /// Of the robots that a refusal names one that is sent to a goal and may be sent elsewhere.
  std::optional<std::uint32_t> whoGivesUp(const SolvabilityVerdict& refusal) const {
    for (auto robot = refusal.robots.rbegin(); robot != refusal.robots.rend(); ++robot) {
      const bool goes = *robot >= question_.takes_part.size() || question_.takes_part[*robot];
      if (goes && answer_.faults[*robot] == GoalFault::kNone) return *robot;
    }
    return std::nullopt;
  }

  void requireValid(const Plan& plan) const {
    const std::vector<Violation> violations = validate(answer_.ground->instance, plan);
    if (violations.empty()) return;
    throw std::logic_error("a fleet's plan is not valid: " + violations.front().message);
  }

  /// @return the plan, with fewer rings.
  Plan keepBest(Plan plan) {
    if (breaksRings()) plan = breakRings(answer_.ground->instance, std::move(plan), {}, deadline_);
    trimToArrival(plan);
    requireValid(plan);
    ExecutionGraph joined = concatenate(question_.graph, question_.cut, plan);
    rings_ = edgesOf(joined);
    const auto rings = static_cast<std::uint32_t>(rings_.size());
    if (answer_.execution && answer_.rings <= rings) return plan;
    answer_.message.clear();
    answer_.rings = rings;
    answer_.execution = std::move(joined);
    return plan;
  }

  /// Keeps the ground as long as cells and goals are the same.
  void prepareGround(const std::vector<Vertex>& goals) {
    const bool same = answer_.ground && answer_.ground->blocked == question_.blocked &&
                      answer_.ground->closed == question_.closed_edges &&
                      answer_.ground->instance.goals() == goals;
    if (same) return;
    setGround(openPart(question_.grid, question_.blocked, question_.closed_edges), goals);
  }

  void setGround(std::shared_ptr<const Grid> open, const std::vector<Vertex>& goals) {
    answer_.ground = std::make_shared<FleetGround>(
        std::move(open), starts_, goals, question_.blocked, question_.times, question_.budget);
    answer_.ground->closed = question_.closed_edges;
  }

  const FleetQuestion& question_;
  const Deadline& deadline_;
  std::vector<Vertex> starts_;
  FleetAnswer answer_;
  std::vector<std::vector<Edge>> rings_;  // of the last plan
  bool is_cut_ = false;                   // whether the ground lacks some of their edges
};

}  // namespace

FleetGround::FleetGround(std::shared_ptr<const Grid> open, const std::vector<Vertex>& starts,
                         const std::vector<Vertex>& goals, std::vector<bool> is_blocked,
                         const MotionTimes& times, const ReplanBudget& budget)
    : instance(Instance::fromVertices(std::move(open), starts, goals)),
      blocked(std::move(is_blocked)),
      replanner(instance, times, budget) {}

std::shared_ptr<const Grid> openPart(const std::shared_ptr<const Grid>& grid,
                                     const std::vector<bool>& blocked,
                                     const std::vector<Edge>& removed) {
  const bool is_whole = std::find(blocked.begin(), blocked.end(), true) == blocked.end();
  if (is_whole && removed.empty()) return grid;
  const auto is_removed = [&](Vertex v, Vertex next) {
    return std::find(removed.begin(), removed.end(), Edge(v, next)) != removed.end();
  };
  std::vector<Edge> edges;
  for (Vertex v = 0; v < grid->size(); ++v) {
    if (blocked[v]) continue;
    for (const Vertex next : grid->graph().neighbours(v)) {
      if (v < next && !blocked[next] && !is_removed(v, next)) edges.emplace_back(v, next);
    }
  }
  return std::make_shared<const Grid>(grid->width(), grid->height(), cellsOf(*grid), edges);
}

FleetAnswer answerFleet(const FleetQuestion& question, const Planner& planner,
                        const PlanRequest& request, const Deadline& deadline) {
  FleetRun run(question, deadline);
  if (!question.anew) return run.improve();
  try {
    return run.planAnew(planner, request);
  } catch (const InputError& error) {
    FleetAnswer answer;
    answer.version = question.version;
    answer.anew = true;
    answer.message = error.what();
    answer.ground = question.ground;
    return answer;
  }
}

}  // namespace split_mapf
