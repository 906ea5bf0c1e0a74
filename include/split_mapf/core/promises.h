#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/execution_cut.h"
#include "split_mapf/core/execution_graph.h"

namespace split_mapf {

/// How far robots are promised their next visits. Null: no such limit.
struct PromiseRule {
  std::uint32_t ahead = 2;   ///< visits beyond the one that a robot has come to
  bool joint_rings = false;  ///< whether a ring may begin, once all its robots are at hand
  const std::vector<bool>* blocked = nullptr;    ///< by vertex: never promised
  const std::vector<bool>* held_back = nullptr;  ///< by robot: promised nothing more
  const Cut* limit = nullptr;                    ///< by robot: the last visit at most
};

/// Promises robots what they may do at once: of each its next visits, as long as no robot is before
/// them there; a robot is not in its own way. Promises are never taken back, so another plan goes
/// behind them; as they wait for nothing but what is done, or promised to the same robot before,
/// they are a downward-closed cut. Cost: O(robots and visits promised).
/// @param promised  by robot, grows.
void growPromises(const ExecutionGraph& graph, const PromiseRule& rule, Cut& promised);

}  // namespace split_mapf
