#pragma once

#include <cstdint>
#include <vector>

#include "search/explored.h"
#include "solver/lacam/robot_distances.h"
#include "split_mapf/core/instance.h"

namespace split_mapf {

constexpr std::uint32_t kNoRobot = 0xffffffffU;

/// Finds robots that have to change places: two that meet in a corridor, each wanting to go where
/// the other comes from, can do so only beyond its end. One of them then backs off to a place with
/// a way to spare, the other follows. A heuristic: whoever asks may do anything else as well.
/// Source: Okumura, IJCAI 2023, section on the swap operation (after Luna and Bekris, IJCAI 2011).
/// Not thread-safe where distances are found on demand.
class SwapRule {
 public:
  SwapRule(const Instance& instance, const RobotDistances& distances,
           const std::vector<std::uint32_t>& robot_at)
      : graph_(instance.graph()),
        goals_(instance.goals()),
        distances_(distances),
        robot_at_(robot_at) {}

  /// The neighbour that `robot`, which would like to go to `wanted`, should let follow while it
  /// backs off; kNoRobot when it should not back off. `next` says where robots go, kNoVertex for
  /// those that are free to choose. Cost: O(length of the corridors around).
  std::uint32_t partnerOf(std::uint32_t robot, Vertex wanted, const Configuration& from,
                          const Configuration& next) const;

 private:
  struct Exits {
    std::uint32_t count = 0;
    Vertex one = kNoVertex;
  };
  Exits exitsOf(Vertex v, Vertex behind) const;
  bool mustSwap(std::uint32_t pusher, std::uint32_t pushed, Vertex pusher_at,
                Vertex pushed_at) const;
  bool canBackOff(Vertex follower_at, Vertex leader_at) const;

  const Graph& graph_;
  const std::vector<Vertex>& goals_;
  const RobotDistances& distances_;
  const std::vector<std::uint32_t>& robot_at_;  // by vertex, kNoRobot where there is none
};

}  // namespace split_mapf
