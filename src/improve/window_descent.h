#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/parallel/executor.h"
#include "split_mapf/solver/registry.h"

namespace split_mapf {

/// Which windows of a plan are solved anew, and by whom.
struct WindowOptions {
  std::string solver;
  std::uint32_t width = 0;            ///< of a window [steps], >= 1
  std::uint32_t offset = 0;           ///< of the first seam [steps], 1 to width
  std::uint64_t expansion_limit = 0;  ///< a window; 0: none
  std::uint64_t seed = 0;
  std::uint32_t threads = 1;
};

/// Tries to take steps out of a plan's makespan: cuts the plan into windows of time, solves each
/// window that may be longer than it has to be anew between the states of its two ends, in
/// parallel, keeps the plan's own slice wherever that gains nothing, stitches and compacts.
/// Returns a valid plan of a smaller makespan, or nothing. Deterministic but for the deadline.
/// A window whose slowest robot needs all of it even alone costs one truncated breadth-first search
/// a robot and no more.
/// Source: ours; a time split (Guo, Han and Yu 2021) whose intermediate states are those of a plan,
/// so that every piece has a plan to fall back on.
/// @pre the plan is valid and its paths end at their arrivals.
std::optional<Plan> shortenWindows(const Instance& instance, const Plan& plan,
                                   const WindowOptions& options, const SolverRegistry& solvers,
                                   Executor& executor, const Deadline& deadline);

}  // namespace split_mapf
