#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "split_mapf/core/close_moves.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/delays.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/pipeline/rest_replanner.h"

namespace split_mapf {

/// How a plan is executed by robots that are late.
enum class ExecutionPolicy {
  kLockstep,  ///< no robot begins a step of the plan before all have ended the one before
  kGraph,     ///< every robot goes on as soon as the order of the visits allows (ExecutionGraph)
  kReplan,    ///< likewise, and what is not promised yet is replanned again and again
};
/// @throws OptionError for another name, naming those that there are.
ExecutionPolicy parseExecutionPolicy(const std::string& name);
std::string toString(ExecutionPolicy policy);

/// Where a robot is at a tick.
struct RobotPlace {
  Vertex from = kNoVertex;  ///< the vertex that it came to last
  Vertex to = kNoVertex;    ///< the one that it is on its way to; where it stands: `from`
  double progress = 0;      ///< of the way, below 1
};

struct SimulationOptions {
  ExecutionPolicy policy = ExecutionPolicy::kReplan;
  DelayModel delays;
  /// Of its move out of a vertex a robot must have done so much before the next may come, see
  /// releaseFraction(); 0: in the same step, as in the plan.
  double release = 0;
  /// Of a planning graph, see ExecutionGraph: then each move has fractions of its own, and
  /// `release` means nothing. Null: a grid.
  std::shared_ptr<const CloseMoves> moves;
  double turn_time = 0;             ///< [steps] of a quarter turn in place, >= 0
  std::uint32_t replan_period = 1;  ///< [steps] between replans, >= 1
  ReplanBudget budget;
  bool avoid_rings = true;  ///< with a release above 0: see RestReplanner; policy kReplan only
  std::uint32_t step_limit = 1000000;  ///< the simulation gives up then
  /// Called after each tick with all robots' places; may be empty.
  std::function<void(const std::vector<RobotPlace>& places)> on_tick;
};

/// @throws OptionError naming what is out of range.
void requireValid(const SimulationOptions& options);

/// A run of steps in which a robot was delayed before it had arrived.
struct DelayInterval {
  std::uint32_t robot = 0;
  std::uint32_t begin = 0;  ///< first step
  std::uint32_t end = 0;    ///< first step after
};

/// What came of a plan.
struct SimulationReport {
  std::uint64_t planned_sum_of_costs = 0;  ///< [steps]
  std::uint32_t planned_makespan = 0;      ///< [steps]
  double executed_sum_of_costs = 0;        ///< [steps] when robots came to their goals for good
  double executed_makespan = 0;            ///< [steps]
  double delayed_share = 0;  ///< of the time that robots had until they arrived, 0 to 1
  std::uint32_t ticks_per_step = 1;
  std::uint32_t replans = 0;
  std::uint32_t replans_taken = 0;  ///< that were cheaper than going on
  double replan_cpu_ms_mean = 0;
  double replan_cpu_ms_max = 0;
  std::uint32_t rings = 0;                ///< joint moves in the plan as it was executed to its end
  std::vector<std::uint32_t> unfinished;  ///< robots that did not arrive
  /// What was executed, a vertex a step: the one that a robot holds, the next one's from the moment
  /// at which it lets go of the one behind it.
  Plan executed;
  std::vector<DelayInterval> delay_intervals;
};

/// Executes a plan in simulated time, robots being late as the model says, and checks what was
/// executed with the independent validator. Time goes in steps of a move each, or tenths of a step
/// where releases or turns need them; delays last whole steps. Robots see that others stand, not
/// for how long. Deterministic but for the deadline and the seconds measured.
/// @throws OptionError for an option out of range; InputError naming the first violation when the
/// plan is not valid. Cost: 10 to 100 ms for 1000 robots without replans.
SimulationReport simulate(const Instance& instance, const Plan& plan,
                          const SimulationOptions& options, const Deadline& deadline = {});

}  // namespace split_mapf
