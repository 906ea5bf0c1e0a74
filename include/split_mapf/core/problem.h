#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "split_mapf/core/grid.h"

namespace split_mapf {

/// A multi-robot path finding problem as a plain value: what is asked, and nothing that anybody
/// works out about it. It may be kept, compared, sent elsewhere (io/problem_bytes.h); whoever
/// solves it makes an Instance of it, which checks it and owns the distance tables.
struct Problem {
  std::shared_ptr<const Grid> grid;
  std::vector<Vertex> starts;  ///< by robot
  std::vector<Vertex> goals;   ///< by robot

  std::uint32_t robots() const { return static_cast<std::uint32_t>(starts.size()); }
};

}  // namespace split_mapf
