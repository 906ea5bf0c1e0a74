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
/// path with the fewest quarter turns of those that arrive when it does, and of these one on which
/// it is seldom just behind another or just before one. Then all once more, and again: robots have
/// made room for others. No cost changes, and the plan stays valid. On a grid whose edges all lead
/// to one of four directions; any other plan comes back as it was.
///
/// A robot that turns is late, and makes late who is close behind it. A place that is close costs a
/// 64th of a turn: so turns come first, as robots seldom have 64 close places to save. Robots are
/// searched for side by side, 32 at a time (StraightSearch); a robot that meets another of its
/// batch on that one's new path is searched for again. Ours. Deterministic but for the deadline,
/// and the plan does not depend on the threads. Cost: 0.3 to 0.6 ms of CPU a robot on large maps;
/// memory: half a byte a vertex and step of the plan, 32 bytes a vertex, 4 more for each thread.
/// @pre the plan is valid, its paths end at their arrivals.
Plan straighten(const Instance& instance, Plan plan, const LentThreads& threads,
                const Deadline& deadline);

}  // namespace split_mapf
