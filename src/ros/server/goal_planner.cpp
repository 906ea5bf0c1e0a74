#include "ros/server/goal_planner.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "ros/convert/map_hash.h"
#include "ros/convert/result_limits.h"
#include "ros/convert/unsolvable_text.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/ros/layout_messages.h"
#include "split_mapf/ros/plan_messages.h"
#include "split_mapf/solvability/refusals.h"

namespace split_mapf {
namespace {

// From a cancel on, for what is done to a plan that was found before it.
constexpr double kFinishCancelledSec = 0.1;

/// Runs a part of the preparation; an option found wrong there becomes a GoalError.
template <typename Part>
auto withGoalErrors(const Part& part) {
  try {
    return part();
  } catch (const UnknownSolverError& error) {
    throw GoalError(Outcome::kUnknownSolver, error.what());
  } catch (const SplitSpecError& error) {
    throw GoalError(Outcome::kInvalidSplit, error.what());
  } catch (const OptionError& error) {
    throw GoalError(Outcome::kInvalidOption, error.what());
  }
}

GoalOptions withStepDuration(GoalOptions options, double longest_step_m) {
  options.step_duration_sec = stepDurationOf(options, longest_step_m);
  return options;
}

void requireDistinctPaths(const std::vector<std::string>& ids) {
  try {
    distinctRosNames(ids, "path");
  } catch (const OptionError& error) {
    throw OptionError(std::string("publish_paths: ") + error.what());
  }
}

/// Cells of each robot's path at least: the straight ways.
std::vector<std::uint32_t> leastPoints(const Instance& instance) {
  const std::uint32_t longest = instance.grid().longestMove();
  std::vector<std::uint32_t> points;
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    const Cell from = instance.grid().cellOf(instance.start(robot));
    const Cell to = instance.grid().cellOf(instance.goal(robot));
    points.push_back((rowsAndColumns(from, to) + longest - 1) / longest + 1);
  }
  return points;
}

/// Cells of each robot's path, or, of robots that have size, poses of its way at most.
std::vector<std::uint32_t> pointsOf(const PreparedGoal& goal, const Plan& plan) {
  std::vector<std::uint32_t> points;
  if (goal.grid.discs) {
    points.assign(plan.paths.size(), stepsOf(goal.grid.discs->problem, plan) + 1);
    return points;
  }
  for (const Path& path : plan.paths)
    points.push_back(static_cast<std::uint32_t>(costOf(path)) + 1);
  return points;
}

/// Says what the same plan would need.
void recordRun(const PreparedGoal& goal, PlanStatistics& statistics) {
  statistics.version = SPLIT_MAPF_VERSION;
  statistics.map_hash = goal.map_hash;
  statistics.seed = static_cast<std::uint32_t>(goal.options.plan.seed);
  statistics.options = toMessage(goal.options);
  if (goal.grid.discs) return;
  // Without a planning graph these are refused, see requireNoGraphOptions().
  statistics.options.passages = PlanOptions::PASSAGES_DEFAULT;
  statistics.options.snap_distance = 0;
}

std::string describeSuccess(const PlanReport& report) {
  char text[256];
  std::snprintf(text, sizeof text,
                "valid plan for %s in %.2f s: makespan %u (lower bound %u), sum of costs "
                "%llu (lower bound %llu)",
                counted(report.robots, "robot").c_str(), report.runtime_sec, report.makespan,
                report.makespan_lower_bound, static_cast<unsigned long long>(report.sum_of_costs),
                static_cast<unsigned long long>(report.sum_of_costs_lower_bound));
  return text;
}

std::string sentenceOf(const PlanReport& report) {
  if (report.plan) return describeSuccess(report);
  return report.message.empty() ? toString(report.termination) : report.message;
}

}  // namespace

void GoalPlanner::requireFits(const PreparedGoal& goal, const std::vector<std::uint32_t>& points,
                              bool least) const {
  requireSendable({goal.robots.ids, points, goal.grid.geometry.frame()}, goal.options.fill_poses,
                  publish_paths_, least);
  const std::uint32_t makespan = *std::max_element(points.begin(), points.end()) - 1;
  requireTimesFit(makespan, goal.options.step_duration_sec, ros::Time::now());
}

GoalOptions GoalPlanner::readOptions(const PlanOptions& asked) const {
  return withGoalErrors([&] {
    GoalOptions options = mergeOptions(asked, defaults_.get());
    planner_.requireValid(options.plan);
    return options;
  });
}

PreparedGoal GoalPlanner::prepare(const boost::shared_ptr<const PlanPathsGoal>& goal,
                                  const GoalOptions& options, const Deadline& deadline) const {
  const char* doing = "while the map was being read";
  try {
    return withGoalErrors([&] { return prepareUntil(goal, options, deadline, doing); });
  } catch (const Interrupted&) {
    throw PreparationStopped(doing);
  }
}

PreparedGoal GoalPlanner::prepareUntil(const boost::shared_ptr<const PlanPathsGoal>& goal,
                                       const GoalOptions& options, const Deadline& deadline,
                                       const char*& doing) const {
  if (goal->robots.empty()) {
    throw GoalError(Outcome::kNoRobots, "the goal has no robots; at least one is needed");
  }
  const std::shared_ptr<const nav_msgs::OccupancyGrid> sent(&goal->map, [goal](const void*) {});
  const std::shared_ptr<const nav_msgs::OccupancyGrid> map = maps_.choose(sent);
  if (asksForRoadmap(options, goal->robots, map->info.resolution)) {
    PlacedDiscs discs =
        placeDiscs(goal->robots, *map, options, transformer_.forGoal(deadline), deadline, doing);
    return prepareDiscs(options, std::move(discs), hashOf(*map, deadline));
  }
  requireNoGraphOptions(goal->options);
  PlanningGrid grid = makePlanningGrid(*map, options.occupancy, options.ignore_specks, deadline);
  doing = "while the robots were being placed";
  PlacedRobots robots = placeRobots(goal->robots, grid, *map, transformer_.forGoal(deadline));
  if (publish_paths_) requireDistinctPaths(robots.ids);
  Instance instance(grid.grid, robots.starts, robots.goals);
  doing = "while it was being checked whether goals can be reached";
  requireReachableGoals(instance, robots.ids, grid.geometry, deadline);
  return PreparedGoal{withStepDuration(options, grid.geometry.info().resolution),
                      hashOf(*map, deadline), std::move(grid), std::move(robots),
                      std::move(instance)};
}

PreparedGoal GoalPlanner::prepareDiscs(const GoalOptions& options, PlacedDiscs discs,
                                       const std::string& map_hash) const {
  if (publish_paths_) requireDistinctPaths(discs.ids);
  const DiscProblem& problem = discs.grid.discs->problem;
  const Instance instance = problem.instance();
  return PreparedGoal{withStepDuration(options, problem.longestStep()), map_hash,
                      std::move(discs.grid), PlacedRobots{std::move(discs.ids), {}, {}}, instance};
}

GoalAnswer GoalPlanner::plan(const PreparedGoal& goal, const Deadline& deadline,
                             const PlanListener& listener) const {
  withGoalErrors([&] { requireFits(goal, leastPoints(goal.instance), true); });
  // Whether a space split fits is known only with the map.
  const PlanReport report = withGoalErrors(
      [&] { return planner_.plan(goal.instance, goal.options.plan, deadline, listener); });
  GoalAnswer answer;
  answer.outcome = outcomeOf(report.termination);
  answer.result.message = sentenceOf(report);
  answer.result.statistics = statisticsOf(report);
  recordRun(goal, answer.result.statistics);
  if (report.refusal) {
    UnsolvableAnswer proof =
        describeUnsolvable(refusalsOf(goal, *report.refusal, deadline), goal.robots.ids, goal.grid);
    answer.result.message = std::move(proof.message);
    answer.result.faults = std::move(proof.faults);
  }
  if (report.plan) writePlan(goal, report, deadline, answer);
  answer.result.outcome = codeOf(answer.outcome);
  return answer;
}

PlanMessages GoalPlanner::messagesOf(const PreparedGoal& goal, const PlanReport& report,
                                     const Deadline& deadline) const {
  withGoalErrors([&] { requireFits(goal, pointsOf(goal, *report.plan), false); });
  PlanMessages messages;
  messages.plan = toMessage(report, goal.robots.ids, goal.grid, goal.options.step_duration_sec,
                            ros::Time::now(), deadline);
  messages.layout = layoutOf(report, goal.grid, messages.plan.header.stamp);
  if (goal.options.fill_poses) fillPoses(messages.plan, deadline);
  return messages;
}

std::optional<PlanMessages> GoalPlanner::messagesInTime(const PreparedGoal& goal,
                                                        const PlanReport& report,
                                                        const Deadline& deadline) const {
  try {
    return messagesOf(goal, report, deadline.forFinish());
  } catch (const Interrupted&) {
    if (!deadline.stopRequested()) return std::nullopt;
  }
  try {
    // Nearly all plans take milliseconds: worth to begin anew, and the client has its plan.
    return messagesOf(goal, report, Deadline(kFinishCancelledSec));
  } catch (const Interrupted&) {
    return std::nullopt;
  }
}

void GoalPlanner::writePlan(const PreparedGoal& goal, const PlanReport& report,
                            const Deadline& deadline, GoalAnswer& answer) const {
  std::string ended;
  if (std::optional<PlanMessages> messages = messagesInTime(goal, report, deadline)) {
    answer.result.plan = std::move(messages->plan);
    answer.layout = std::move(messages->layout);
  } else {
    answer.outcome = Outcome::kTimeout;
    ended = "the time limit passed while a plan was being written into the result; ";
  }
  if (deadline.stopRequested()) {
    answer.outcome = Outcome::kCancelled;
    ended = ended.empty() ? "cancelled; "
                          : "cancelled while a plan was being written into the result; ";
  }
  answer.result.message = ended + answer.result.message;
}

std::vector<SolvabilityVerdict> refusalsOf(const PreparedGoal& goal,
                                           const SolvabilityVerdict& first,
                                           const Deadline& deadline) {
  std::vector<SolvabilityVerdict> all = findRefusals(goal.instance, deadline);
  // The deadline may have come between.
  if (all.empty()) all.push_back(first);
  return all;
}

GoalAnswer refusal(const GoalError& error) {
  GoalAnswer answer = refusal(error.outcome(), error.what());
  answer.result.faults = error.faults();
  return answer;
}

GoalAnswer refusal(Outcome outcome, const std::string& message) {
  GoalAnswer answer;
  answer.outcome = outcome;
  answer.result.outcome = codeOf(outcome);
  answer.result.message = message;
  return answer;
}

}  // namespace split_mapf
