#pragma once

#include <cstdint>

#include "split_mapf/core/graph.h"

namespace split_mapf {

/// What it costs a robot to go on from a vertex, where distances alone do not tell.
class StepPrices {
 public:
  virtual ~StepPrices() = default;
  /// @param occupant  who stands there now, kNoRobot if nobody does; it may be the robot itself.
  /// @return in units of its own.
  virtual std::uint32_t priceOf(std::uint32_t robot, Vertex v, std::uint32_t occupant) const = 0;
};

}  // namespace split_mapf
