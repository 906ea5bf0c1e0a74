#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <split_mapf/RobotFault.h>

namespace split_mapf {

/// The faults of a goal's robots: the first kMostFaults in the goal's order, and how many there
/// are. However many robots are at fault, the memory is bounded.
class FaultList {
 public:
  static constexpr std::size_t kMostFaults = 1000;

  /// @param robot  its index in the goal. Faults of one robot keep their order.
  void add(std::size_t robot, RobotFault fault);

  bool empty() const { return total_ == 0; }
  /// How many were added.
  std::size_t total() const { return total_; }
  /// The first kMostFaults, in the goal's order.
  std::vector<RobotFault> first() const;

 private:
  struct Entry {
    std::size_t robot;
    RobotFault fault;
  };
  static void cut(std::vector<Entry>& entries);

  std::vector<Entry> entries_;
  std::size_t total_ = 0;
};

}  // namespace split_mapf
