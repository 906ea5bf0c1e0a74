#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/rolling/move_graph.h"
#include "pipeline/rolling/step_wish.h"
#include "pipeline/rolling/window_table.h"

namespace split_mapf::rolling {

/// Finds robots that have to change places: two that meet in a lane, each wanting to go where the
/// other comes from, can do so only beyond its end; likewise one that wants into a dead end in
/// which an idle one stands. One of them then backs off to a place with a way to spare, and the
/// other follows. A heuristic: whoever asks may do anything else as well. Source: Okumura, IJCAI
/// 2023, section on the swap operation; here by slopes, for goals that are passed. Not thread-safe.
class SwapRule {
 public:
  /// @param robot_at  by vertex, kNoRobot where there is none; outlives this object, as the graph
  SwapRule(const MoveGraph& graph, const std::vector<std::uint32_t>& robot_at)
      : graph_(graph), robot_at_(robot_at) {}

  /// The neighbour that `robot`, which would like to take slot `wanted`, should let follow while it
  /// backs off; kNoRobot when it should not back off. @param moves  by robot, kNoSlot for those
  /// that are free to choose. Cost: O(length of the lanes around).
  std::uint32_t partnerOf(std::uint32_t robot, Slot wanted, const std::vector<StepWish>& wishes,
                          const std::vector<Slot>& moves, const WindowTable& table) const;

 private:
  struct Exits {
    std::uint32_t count = 0;
    Vertex one = kNoVertex;
  };
  Exits exitsOf(Vertex v, Vertex behind, const std::vector<StepWish>& wishes,
                const WindowTable& table) const;
  bool mustSwap(const std::uint8_t* pusher, const std::uint8_t* pushed, Vertex pusher_at,
                Vertex pushed_at, const std::vector<StepWish>& wishes,
                const WindowTable& table) const;
  bool canBackOff(Vertex follower_at, Vertex leader_at, const std::vector<StepWish>& wishes,
                  const WindowTable& table) const;
  bool comesNearer(const std::uint8_t* slope, Vertex from, Vertex to) const {
    return slope != nullptr && (slope[from] >> graph_.slotOf(from, to) & 1U) != 0;
  }

  const MoveGraph& graph_;
  const std::vector<std::uint32_t>& robot_at_;
};

}  // namespace split_mapf::rolling
