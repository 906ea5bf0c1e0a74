#pragma once

#include <atomic>
#include <memory>

#include "split_mapf/plugin/solver_plugin.h"
#include "split_mapf/plugin/splitter_plugin.h"

namespace split_mapf::test {

/// Lets a plug-in that hangs go on, so that a test leaves no thread behind.
extern std::atomic<bool> misbehaving_may_end;
/// Set by a plug-in that hangs, or will be late, when it has been asked.
extern std::atomic<bool> misbehaving_has_begun;

constexpr const char* kThrowsWhenLoaded = "SPLIT_MAPF_MISBEHAVING_THROWS_WHEN_LOADED";

/// Solver `misbehaving`, whose option `how` says what is wrong with it: none, throw, throw_int,
/// hang (until misbehaving_may_end), late (ends a little after its deadline), collide, outside,
/// no_paths, no_plan, unsolvable, timeout, bound, make (throws when it is made).
class MisbehavingSolver : public SolverPlugin {
 public:
  /// @throws int where the environment has kThrowsWhenLoaded.
  MisbehavingSolver();
  SolverInfo info() const override;
};

/// Splitter `misbehaving`, likewise: none, throw, hang, null, robots, twice, left_out, other_map,
/// seam (pieces that do not follow each other), no_pieces, merge_nothing (a merge leaves the piece
/// where it is), reuse_id (a merge makes another piece 1).
class MisbehavingSplitter : public SplitterPlugin {
 public:
  SplitterInfo info() const override;
};

}  // namespace split_mapf::test
