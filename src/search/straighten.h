#pragma once

#include <cstdint>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/parallel/lent_threads.h"

namespace split_mapf {

/// Quarter turns in place along a path on a grid: a right angle is one, going back is two.
std::uint32_t countTurns(const Grid& grid, const Path& path);

/// Takes turns out of a valid plan: each robot in turn gets, among the paths of all others, the
/// path with the fewest quarter turns of those that arrive when it does. Then each once more, and
/// again, another one with as many where it has none with fewer: that makes room for others. No
/// cost changes, the plan stays valid, and it never has more turns. On a grid whose edges all lead
/// to one of four directions; any other plan comes back as it was.
///
/// A state is a vertex and a heading, with one bit for each step at which the robot may be there:
/// as it arrives at a given step, these are no more than it may lose on its way, and 63 are looked
/// at in one go. States are met by the turns behind and at least ahead of them (A*): two where the
/// goal is neither straight ahead nor seen from a corner straight ahead. Robots are searched for
/// side by side, 32 at a time; a robot that meets another of its batch on that one's new path is
/// searched for again. Ours. Deterministic but for the deadline, and the plan does not depend on
/// the threads. Cost: 0.5 to 2 ms of CPU a robot on large maps; memory: a table of the plan, 32
/// bytes a vertex, and 12 more for each thread.
/// @pre the plan is valid, its paths end at their arrivals.
Plan straighten(const Instance& instance, Plan plan, const LentThreads& threads,
                const Deadline& deadline);

}  // namespace split_mapf
