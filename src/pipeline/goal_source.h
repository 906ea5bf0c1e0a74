#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/random.h"
#include "split_mapf/pipeline/roll.h"

namespace split_mapf {

/// Where the robots of a run get their goals from: lists, or chance. Not thread-safe.
class GoalSource {
 public:
  /// @throws InputError where lists and starts differ in number.
  GoalSource(const Grid& grid, const RollTask& task, std::uint64_t seed);
  /// The robot's next goal; kNoVertex when it has had them all.
  Vertex next(std::uint32_t robot);

 private:
  std::vector<std::vector<Vertex>> goals_;
  std::vector<std::size_t> given_;
  bool random_;
  RandomEngine engine_;
  std::vector<std::vector<Vertex>> parts_;  // connected parts, in the order of their first vertices
  std::vector<std::uint32_t> part_;         // by vertex
  std::vector<Vertex> last_;                // by robot: its last goal
};

}  // namespace split_mapf
