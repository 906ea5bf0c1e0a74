#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "split_mapf/core/plan.h"

namespace split_mapf::ilp {

/// What branching demands of one robot.
struct RobotRules {
  static constexpr std::uint32_t kNever = std::numeric_limits<std::uint32_t>::max();

  /// Not at `vertex` at any step of [begin, end).
  struct Ban {
    Vertex vertex = kNoVertex;
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
  };
  /// At `vertex` at `step`.
  struct Post {
    Vertex vertex = kNoVertex;
    std::uint32_t step = 0;
  };

  std::vector<Ban> bans;
  std::vector<Post> posts;
  std::uint32_t earliest_arrival = 0;
  std::uint32_t latest_arrival = kNever;

  /// Whether a path, with its stay at the goal, obeys.
  /// @param horizon  steps behind it are of no interest.
  bool allow(const Path& path, std::uint32_t horizon) const;
};

}  // namespace split_mapf::ilp
