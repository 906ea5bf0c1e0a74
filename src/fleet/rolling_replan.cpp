#include "split_mapf/fleet/rolling_replan.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "search/departures.h"
#include "search/ring_breaking.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/execution_cut.h"
#include "split_mapf/core/execution_forecast.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/precedence.h"

namespace split_mapf {
namespace {

// States that are looked at for a window: at most, and whatever the deadline says.
constexpr std::uint64_t kPerRobot = 150;
constexpr std::uint64_t kLeast = 20000;
constexpr std::uint64_t kHurriedShare = 10;
constexpr std::uint64_t kAtOnce = 2000;
// Tries to find a window in which nobody has to wait for a rotation soon.
constexpr std::uint32_t kTries = 3;
// A rotation that is further ahead may be planned away before it is due.
constexpr std::uint32_t kSoon = 4;

bool passes(const FleetQuestion& question, std::uint32_t robot, Vertex goal) {
  const Precedence& order = question.graph.precedence();
  for (VisitId v = question.graph.at(robot) + 1; v <= question.cut[robot]; ++v) {
    if (order[v].vertex == goal) return true;
  }
  return false;
}

/// The steps behind the cut at which robots are done with what lies before it, and with standing.
std::vector<std::uint32_t> departuresOf(const FleetQuestion& question) {
  const ExecutionGraph& graph = question.graph;
  const Precedence& order = graph.precedence();
  const std::uint32_t move = question.times.move;
  const auto turns = question.times.turn > 0
                         ? quarterTurns(*question.grid, order, question.came_from)
                         : std::vector<std::uint8_t>{};
  const Forecast now = forecast(graph, question.times, turns, question.stands);
  std::vector<std::uint32_t> departures(question.numbers.size(), 0);
  for (std::uint32_t robot = 0; robot < order.robots(); ++robot) {
    std::uint32_t free = now.ends[question.cut[robot]];
    if (question.cut[robot] == graph.at(robot)) free = std::max(free, question.stands[robot]);
    departures[robot] = (free + move - 1) / move;
  }
  return departures;
}

/// The vertices where robots are when all that is promised is done; those that join come last.
std::vector<Vertex> startsOf(const FleetQuestion& question) {
  const Precedence& order = question.graph.precedence();
  std::vector<Vertex> starts;
  for (std::uint32_t robot = 0; robot < order.robots(); ++robot) {
    starts.push_back(order[question.cut[robot]].vertex);
  }
  starts.insert(starts.end(), question.joiners.begin(), question.joiners.end());
  return starts;
}

bool isSent(const FleetQuestion& question, std::uint32_t robot) {
  const bool is_new = robot >= question.takes_part.size();
  if (!is_new && !question.takes_part[robot]) return false;
  const Vertex goal = question.goals[robot];
  return goal != kNoVertex && (is_new || !passes(question, robot, goal));
}

/// What of a plan can be done when no rotation begins. @return whether anything is left out that
/// would begin soon.
bool cutRotations(const FleetQuestion& question, Plan& plan, std::vector<std::uint32_t>& waiting) {
  const ExecutionGraph graph(Precedence(plan, question.grid->size()), question.graph.release());
  waiting.clear();
  if (graph.rings().empty()) return false;
  const Precedence& order = graph.precedence();
  Cut all;
  for (std::uint32_t robot = 0; robot < order.robots(); ++robot) all.push_back(order.last(robot));
  const Cut cut = withoutRings(graph, all);
  for (const Ring& ring : graph.rings()) {
    const Visit& first = order[ring[question.budget.seed % ring.size()]];
    if (first.step <= kSoon) waiting.push_back(first.robot);
  }
  for (std::uint32_t robot = 0; robot < order.robots(); ++robot) {
    if (cut[robot] < order.last(robot)) plan.paths[robot].resize(order[cut[robot]].step + 1);
  }
  return !waiting.empty();
}

}  // namespace

RollingReplanner::RollingReplanner(std::shared_ptr<const Grid> grid, const RollingOptions& options)
    : grid_(std::move(grid)),
      options_(options),
      rolling_(std::make_unique<Rolling>(grid_, options_)),
      checker_(grid_) {}

FleetAnswer RollingReplanner::answer(const FleetQuestion& question, const Deadline& deadline) {
  FleetAnswer answer;
  answer.version = question.version;
  answer.anew = question.anew;
  answer.ground = question.ground;
  try {
    closeEdges(question.closed_edges);
    ask(question);
    const bool breaks = question.avoid_rings && question.graph.release() > 0;
    std::vector<std::uint32_t> waiting;
    for (std::uint32_t tries = 1;; ++tries) {
      const RollingAnswer found = search(question, deadline);
      answer.faults = faultsOf(question, found);
      Plan plan;
      plan.paths = found.paths;
      trimToArrival(plan);
      if (breaks) plan = withoutRotations(question, std::move(plan), deadline);
      const bool is_late = breaks && cutRotations(question, plan, waiting);
      requireValid(plan);
      if (!is_late || tries == kTries) {
        answer.execution.emplace(concatenate(question.graph, question.cut, plan));
        answer.rings = static_cast<std::uint32_t>(answer.execution->rings().size());
        return answer;
      }
      // One of each rotation waits until it is over.
      for (const std::uint32_t robot : waiting) {
        Path& prefix = question_.robots[robot].prefix;
        prefix.resize(std::min<std::size_t>(prefix.size() + tries + 1, options_.window + 1U),
                      prefix.back());
      }
      steps_over_ = 0;
    }
  } catch (const InputError& error) {
    answer.message = error.what();
  }
  return answer;
}

void RollingReplanner::ask(const FleetQuestion& question) {
  const double step_sec = question.step_sec;
  if (!has_begun_) begun_sec_ = question.asked_sec;
  has_begun_ = true;
  const double over = std::floor((question.asked_sec - begun_sec_) / step_sec);
  begun_sec_ += over * step_sec;
  steps_over_ = static_cast<std::uint32_t>(std::min(over, 1e6));

  const std::vector<std::uint32_t> departures = departuresOf(question);
  const Precedence rest = restBehind(question.graph, question.cut);
  const std::vector<std::uint32_t> free(departures.begin(), departures.begin() + rest.robots());
  Plan known = planOf(rest, earliestSteps(rest, free));
  const std::vector<Vertex> starts = startsOf(question);
  question_.blocked.clear();
  for (Vertex v = 0; v < question.closed.size(); ++v) {
    if (question.closed[v]) question_.blocked.push_back(v);
  }
  question_.robots.assign(starts.size(), RollingRobot());
  for (std::uint32_t robot = 0; robot < starts.size(); ++robot) {
    RollingRobot& asked = question_.robots[robot];
    asked.id = question.numbers[robot];
    asked.prefix.assign(std::min(departures[robot], options_.window) + std::size_t{1},
                        starts[robot]);
    if (isSent(question, robot)) asked.goals = {question.goals[robot]};
    asked.age = question.ages[robot];
    if (robot >= question.takes_part.size()) continue;
    asked.may_move = question.takes_part[robot];
    if (!question.fresh[robot]) asked.known = std::move(known.paths[robot]);
  }
}

RollingAnswer RollingReplanner::search(const FleetQuestion& question, const Deadline& deadline) {
  rolling_->begin(question_, steps_over_);
  const std::uint64_t asked = question.budget.expansions;
  const std::uint64_t most =
      asked > 0 ? asked : std::max(kLeast, kPerRobot * question_.robots.size());
  std::uint64_t done = 0;
  while (done < most) {
    const bool is_hurried = deadline.expired();
    if (is_hurried && done * kHurriedShare >= most) break;
    const std::uint64_t more = rolling_->improve(std::min(kAtOnce, most - done));
    if (more == 0) break;
    done += more;
  }
  return rolling_->answer();
}

Plan RollingReplanner::withoutRotations(const FleetQuestion& question, Plan plan,
                                        const Deadline& deadline) {
  const Precedence order(plan, grid_->size());
  if (findRings(order).empty()) return plan;
  std::vector<Vertex> starts;
  std::vector<Vertex> ends;
  std::vector<std::uint32_t> departures;
  for (std::uint32_t robot = 0; robot < plan.paths.size(); ++robot) {
    starts.push_back(plan.paths[robot].front());
    ends.push_back(plan.paths[robot].back());
    departures.push_back(static_cast<std::uint32_t>(question_.robots[robot].prefix.size()) - 1);
  }
  const Instance instance =
      Instance::fromVertices(openGrid(question.blocked), starts, ends, DistanceExtent::kOnDemand);
  return breakRings(instance, std::move(plan), Departures(std::move(departures)), deadline);
}

void RollingReplanner::requireValid(const Plan& plan) {
  const std::optional<std::string> wrong = checker_.violation(plan.paths);
  if (wrong) throw std::logic_error("a fleet's window is not valid: " + *wrong);
}

std::vector<GoalFault> RollingReplanner::faultsOf(const FleetQuestion& question,
                                                  const RollingAnswer& found) const {
  std::vector<GoalFault> faults(question_.robots.size(), GoalFault::kNone);
  for (const std::uint32_t robot : found.cut_off) {
    const bool is_closed = question.closed[question.goals[robot]];
    faults[robot] = is_closed ? GoalFault::kBlocked : GoalFault::kNoWay;
  }
  return faults;
}

/// They change when a robot drops out on its way, or comes back: seldom.
void RollingReplanner::closeEdges(const std::vector<Edge>& closed) {
  if (closed == closed_edges_) return;
  const std::vector<bool> none(grid_->size(), false);
  rolling_ = std::make_unique<Rolling>(openPart(grid_, none, closed), options_);
  closed_edges_ = closed;
  open_.reset();
}

const std::shared_ptr<const Grid>& RollingReplanner::openGrid(const std::vector<bool>& blocked) {
  if (!open_ || open_blocked_ != blocked) {
    open_ = openPart(grid_, blocked, closed_edges_);
    open_blocked_ = blocked;
  }
  return open_;
}

}  // namespace split_mapf
