#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// What can be wrong with a plan.
enum class ViolationKind {
  kRobotCount,      ///< not one path a robot
  kEmptyPath,       ///< a path without a single vertex
  kOutsideGrid,     ///< an entry that is no free cell of the grid
  kWrongStart,      ///< the first entry is not the start
  kWrongGoal,       ///< the last entry is not the goal
  kJump,            ///< a move to a cell that is not adjacent
  kVertexConflict,  ///< two robots in one cell at one step
  kSwapConflict,    ///< two robots exchange their cells in one step
};

/// One violation; `robot`, `other`, `step` mean something where the kind needs them.
struct Violation {
  ViolationKind kind = ViolationKind::kRobotCount;
  std::uint32_t robot = 0;
  std::uint32_t other = 0;
  std::uint32_t step = 0;  ///< of a move: the step at which it ends
  std::string message;
};

/// Checks a plan against its instance and lists every violation: first those of single robots,
/// robot by robot, then those between two robots, step by step. Shares no code with any solver.
///
/// A robot whose path has ended stays and can still be run into. A vertex conflict that lasts is
/// listed once a step while either of the two paths lasts. Where more than two robots stand in one
/// cell, each is listed once a step, against the lowest-numbered robot there (`robot`, the later
/// one in `other`); swaps likewise. Surplus paths, without a robot in the instance, are checked for
/// all but start and goal. Waiting at the goal behind the arrival is fine.
/// Thread-safe. Cost: O(robots * makespan) for a plan in which few robots collide, and a few dozen
/// bytes a robot, whatever the grid.
/// @param deadline  looked at once in some thousand entries; nothing is known of the plan when it
/// has expired. @throws Interrupted then.
std::vector<Violation> validate(const Instance& instance, const Plan& plan,
                                const Deadline& deadline = {});

/// The same for paths given as cells, which may be blocked or outside the grid: what a file or a
/// message claims is checked as it stands.
std::vector<Violation> validate(const Instance& instance,
                                const std::vector<std::vector<Cell>>& paths);

}  // namespace split_mapf
