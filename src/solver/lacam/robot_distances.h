#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/instance.h"

namespace split_mapf {

/// The distances of all robots to their goals, read without a look at the kind of table where the
/// tables take 16 bits. @pre the instance outlives this object; see DistanceTable for threads.
class RobotDistances {
 public:
  explicit RobotDistances(const Instance& instance) {
    tables_.reserve(instance.robots());
    narrow_.reserve(instance.robots());
    for (std::uint32_t i = 0; i < instance.robots(); ++i) {
      tables_.push_back(instance.distances(i));
      narrow_.push_back(tables_[i]->narrowEntries());
    }
  }
  /// @pre the robot can reach its goal from `v`.
  std::uint32_t operator()(std::uint32_t robot, Vertex v) const {
    const std::uint16_t* const narrow = narrow_[robot];
    return narrow != nullptr ? narrow[v] : (*tables_[robot])(v);
  }

 private:
  std::vector<HeldDistances> tables_;
  std::vector<const std::uint16_t*> narrow_;
};

}  // namespace split_mapf
