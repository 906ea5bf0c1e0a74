#pragma once

#include <atomic>
#include <memory>

#include "split_mapf/plugin/solver_plugin.h"
#include "split_mapf/plugin/splitter_plugin.h"

namespace split_mapf::test {

/// Lets a plug-in that hangs go on, so that a test leaves no thread behind.
extern std::atomic<bool> misbehaving_may_end;

/// Solver `misbehaving`, whose option `how` says what is wrong with it: none, throw, throw_int,
/// hang (until misbehaving_may_end), late (ends 0.2 s after its deadline), collide, outside,
/// no_paths, no_plan, unsolvable, timeout, bound, make (throws when it is made).
class MisbehavingSolver : public SolverPlugin {
 public:
  SolverInfo info() const override;
};

/// Splitter `misbehaving`, likewise: none, throw, hang, null, robots, twice, left_out, other_map,
/// seam (pieces that do not follow each other), no_pieces.
class MisbehavingSplitter : public SplitterPlugin {
 public:
  SplitterInfo info() const override;
};

}  // namespace split_mapf::test
