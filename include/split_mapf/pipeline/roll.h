#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/delays.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/pipeline/rolling.h"

namespace split_mapf {

/// What robots have to do in a run of goals that come one by one.
struct RollTask {
  std::vector<Vertex> starts;              ///< by robot, no two the same
  std::vector<std::vector<Vertex>> goals;  ///< by robot, in order; all empty lists with `random`
  /// Whoever reaches a goal gets another one, drawn uniformly from what it can reach, never where
  /// its last one was.
  bool random = false;
};

struct RollOptions {
  RollingOptions rolling;
  std::uint32_t steps = 400;      ///< at least 1
  std::uint32_t warmup = 80;      ///< [steps] left out of what is measured, less than `steps`
  std::uint32_t known_goals = 2;  ///< of each robot that the planner is told, at least 1
  /// Effort a step: expansions, or with `step_sec` above 0 as many budgets as fit into so much CPU
  /// time [s] of each thread, from the moment the goals are known, but at least one.
  std::uint64_t step_expansions = 100000;
  double step_sec = 0;
  /// Robots that stand in a step that would have moved them, and with them whoever would come where
  /// they are. The planner learns of a delay when it has begun, and how long others were.
  DelayModel delays;
};

/// One goal, as it was reached.
struct ReachedGoal {
  std::uint32_t step = 0;
  Vertex goal = kNoVertex;
};

/// What came of a run. What is counted, is counted behind the warm-up.
struct RollReport {
  std::uint32_t steps = 0;  ///< that were done: fewer than asked for when the deadline expired
  std::uint64_t goals_reached = 0;
  double throughput = 0;  ///< goals a step
  /// Steps that robots with goals came nearer by, over all their steps: 1 where no robot ever waits
  /// for others or makes a detour. With these goals more than throughput / share cannot be.
  double free_flow_share = 0;
  double service_mean = 0;  ///< [steps] from goal to goal
  std::uint32_t service_median = 0;
  std::uint32_t service_p99 = 0;
  std::uint32_t service_max = 0;
  /// [steps] the longest that any robot with a goal was without reaching one, to the end.
  std::uint32_t longest_wait = 0;
  double waiting = 0;  ///< share of the steps of robots with goals in which they stood
  double delayed = 0;  ///< share of the robots' time in which they were delayed
  double resting = 0;  ///< of the same, in which they had goals and rested, as a crowd had jammed
  double turns = 0;    ///< turns a move
  double step_cpu_ms_mean = 0;
  double step_cpu_ms_max = 0;
  double valid_ms_max = 0;  ///< until a valid step was there, the first left out
  double first_step_ms = 0;
  std::uint64_t expansions = 0;
  std::uint64_t escorts = 0;                      ///< steps of escorts under way
  std::vector<Path> paths;                        ///< what was done, an entry a step
  std::vector<std::vector<ReachedGoal>> reached;  ///< by robot
};

/// Lets a fleet run: each step it is planned on, one step is done, and robots that have come to
/// their goals get the next ones. Every step done is checked by FleetChecker. The same task,
/// options and expansions give the same run at any thread count.
/// @throws InputError for starts that are the same, and OptionError for options out of range;
/// std::logic_error when a step was not valid, which would be a bug. Thread-safe.
RollReport roll(const std::shared_ptr<const Grid>& grid, const RollTask& task,
                const RollOptions& options, const Deadline& deadline = {});

/// Draws starts uniformly from the largest connected part, no two the same.
/// @throws InputError when there are more robots than cells in it.
std::vector<Vertex> drawStarts(const Grid& grid, std::uint32_t robots, std::uint64_t seed);

}  // namespace split_mapf
