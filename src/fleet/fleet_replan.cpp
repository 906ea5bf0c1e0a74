#include "split_mapf/fleet/fleet_replan.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "fleet/fleet_goals.h"
#include "fleet/fleet_rotations.h"
#include "pipeline/mended_rest.h"
#include "search/ring_breaking.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/validate.h"

namespace split_mapf {
namespace {

// Plans that are made to find one without rings.
constexpr std::uint32_t kTriesAtRings = 4;
// Other places for robots without a way, where rings stay whatever the plan.
constexpr std::uint32_t kPlacesTried = 4;

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
    const double steps = std::max(0.0, question_.asked_sec) / question_.step_sec;
    rest.asked = static_cast<std::uint64_t>(steps * question_.times.move);
    ReplanAnswer found = answer_.ground->replanner.replan(rest, deadline_);
    answer_.rings = found.rings;
    answer_.execution = std::move(found.execution);
    return std::move(answer_);
  }

  FleetAnswer planAnew(const Planner& planner, const PlanRequest& request) {
    starts_.insert(starts_.end(), question_.joiners.begin(), question_.joiners.end());
    takes_part_ = question_.takes_part;
    takes_part_.resize(starts_.size(), true);
    const auto open = openPart(question_.grid, question_.blocked, question_.closed_edges);
    answer_.faults.assign(starts_.size(), GoalFault::kNone);
    for (std::size_t given_up = 0; given_up <= starts_.size(); ++given_up) {
      FleetGoals chosen = goalsOn(*open);
      answer_.faults = std::move(chosen.faults);
      setGround(open, chosen.goals);
      if (tryToMend(open)) break;
      const std::optional<std::uint32_t> hopeless = tryToPlan(planner, request);
      if (!hopeless) break;
      answer_.faults[*hopeless] = GoalFault::kNoWay;
    }
    makeRoomToTurn(open, planner, request);
    giveUpForTheOthers(open, planner, request);
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

  FleetGoals goalsOn(const Grid& open, const std::vector<bool>& shunned = {}) const {
    return chooseGoals(open, question_.blocked, starts_, question_.goals, takes_part_,
                       answer_.faults, shunned);
  }

  /// Where every plan rotates robots it may be a robot without a way that stands where others have
  /// to pass each other: then such robots are sent away from where the rings are, or all of them
  /// farther, and the plan with the fewest rings is the answer.
  void makeRoomToTurn(const std::shared_ptr<const Grid>& open, const Planner& planner,
                      const PlanRequest& request) {
    std::vector<bool> shunned(open->size(), false);
    for (std::uint32_t tries = 0; tries < kPlacesTried && ringsStay(); ++tries) {
      const std::vector<Vertex> before = answer_.ground->instance.goals();
      // Where there was no plan at all, the rings of the answer are still those to leave.
      for (const Rotation& ring : rings_.empty() ? best_rings_ : rings_) {
        for (const Edge& edge : ring.edges) shunned[edge.first] = shunned[edge.second] = true;
      }
      FleetGoals chosen = goalsOn(*open, shunned);
      if (chosen.goals == before) {
        for (std::uint32_t robot = 0; robot < before.size(); ++robot) {
          if (answer_.faults[robot] != GoalFault::kNone) shunned[before[robot]] = true;
        }
        chosen = goalsOn(*open, shunned);
      }
      // Nobody's goal is given up for it.
      if (chosen.goals == before || chosen.faults != answer_.faults) return;
      planTo(chosen.goals, open, planner, request);
    }
  }

  void planTo(const std::vector<Vertex>& goals, const std::shared_ptr<const Grid>& open,
              const Planner& planner, const PlanRequest& request) {
    setGround(open, goals);
    rings_.clear();
    is_cut_ = false;
    tryToPlan(planner, request);
  }

  /// Where plans made anew have moved nobody, a robot of the rings gives up its goal if that leaves
  /// fewer rings, or two of a ring do, or all of it, then others: better some that are named than
  /// all who stand for good.
  void giveUpForTheOthers(const std::shared_ptr<const Grid>& open, const Planner& planner,
                          const PlanRequest& request) {
    for (bool gained = question_.stalled && question_.stalled_before; gained && ringsStay();) {
      gained = false;
      for (const std::vector<std::uint32_t>& group : groupsOf(ringsOfThoseWhoMay())) {
        gained = giveUp(group, open, planner, request);
        if (gained) break;
      }
    }
  }

  /// Of the answer so far, without robots that have given up already.
  std::vector<Rotation> ringsOfThoseWhoMay() const {
    std::vector<Rotation> rings = best_rings_;
    const auto may_not = [this](std::uint32_t robot) { return !mayGiveUp(robot); };
    for (Rotation& ring : rings) {
      ring.robots.erase(std::remove_if(ring.robots.begin(), ring.robots.end(), may_not),
                        ring.robots.end());
    }
    return rings;
  }

  /// The robots give up their goals if that leaves fewer rings. @return whether it does.
  bool giveUp(const std::vector<std::uint32_t>& robots, const std::shared_ptr<const Grid>& open,
              const Planner& planner, const PlanRequest& request) {
    if (deadline_.expired()) return false;
    const std::vector<GoalFault> faults = answer_.faults;
    const std::uint32_t rings = answer_.rings;
    for (const std::uint32_t robot : robots) answer_.faults[robot] = GoalFault::kNoWay;
    const FleetGoals chosen = goalsOn(*open);
    if (chosen.faults == answer_.faults) {
      planTo(chosen.goals, open, planner, request);
      // They may stand where the others have to pass.
      makeRoomToTurn(open, planner, request);
    }
    if (answer_.rings < rings) return true;
    answer_.faults = faults;
    return false;
  }

  /// Of the plan that is the answer so far.
  bool ringsStay() const {
    return breaksRings() && answer_.execution && answer_.rings > 0 && !deadline_.expired();
  }

  /// Takes an edge out of the cycle of each ring of the last plan, where no robot can rotate then.
  /// As the edge lies on a cycle, its ends stay connected.
  void cutRings(std::uint32_t number) {
    std::vector<Edge> removed = question_.closed_edges;
    for (const Rotation& ring : rings_) {
      removed.push_back(ring.edges[(question_.budget.seed + number) % ring.edges.size()]);
    }
    const std::vector<Vertex> goals = answer_.ground->instance.goals();
    setGround(openPart(question_.grid, question_.blocked, removed), goals);
    is_cut_ = true;
  }

  /// Of the robots that a refusal names one that is sent to a goal and may be sent elsewhere; where
  /// none is, one for whom one of them has to leave its place.
  std::optional<std::uint32_t> whoGivesUp(const SolvabilityVerdict& refusal) const {
    for (auto robot = refusal.robots.rbegin(); robot != refusal.robots.rend(); ++robot) {
      if (mayGiveUp(*robot)) return *robot;
    }
    const std::vector<Vertex>& goals = answer_.ground->instance.goals();
    for (const std::uint32_t robot : refusal.robots) {
      const auto comer = std::find(goals.begin(), goals.end(), starts_[robot]);
      const auto other = static_cast<std::uint32_t>(comer - goals.begin());
      if (comer != goals.end() && mayGiveUp(other)) return other;
    }
    return std::nullopt;
  }

  bool mayGiveUp(std::uint32_t robot) const {
    return takes_part_[robot] && answer_.faults[robot] == GoalFault::kNone;
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
    rings_ = rotationsOf(joined);
    const auto rings = static_cast<std::uint32_t>(rings_.size());
    if (answer_.execution && answer_.rings <= rings) return plan;
    answer_.message.clear();
    answer_.rings = rings;
    best_rings_ = rings_;
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
  std::vector<bool> takes_part_;  // of those that join, too; plans made anew
  FleetAnswer answer_;
  std::vector<Rotation> rings_;       // of the last plan
  std::vector<Rotation> best_rings_;  // of the plan that is the answer
  bool is_cut_ = false;  // whether the ground lacks some edges of the last plan's rings
};

}  // namespace

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
