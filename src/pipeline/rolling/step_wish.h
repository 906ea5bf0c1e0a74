#pragma once

#include <cstdint>

#include "pipeline/rolling/move_graph.h"

namespace split_mapf::rolling {

/// One robot's part in a step.
struct StepWish {
  Vertex at = kNoVertex;
  bool bound = false;                   ///< takes the slot `wanted`, whatever others want
  Slot wanted = MoveGraph::kNoSlot;     ///< tried first, kNoSlot: what the slope says
  const std::uint8_t* slope = nullptr;  ///< to its goal; nullptr: idle, it would rather stay
  Slot straight = kWait;                ///< goes on as it came; kWait: none does

  bool isIdle() const { return slope == nullptr; }
};

}  // namespace split_mapf::rolling
