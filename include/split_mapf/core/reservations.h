#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "split_mapf/core/grid.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// Space and time that others have: the paths of robots that are not planned now. Each begins at
/// step 0 and stays at its end for good. Immutable; thread-safe.
class Reservations {
 public:
  Reservations() = default;
  /// @throws InputError naming path and cell when a path is empty, leaves the grid or jumps, or
  /// when two of them conflict.
  Reservations(const std::shared_ptr<const Grid>& grid, std::vector<Path> paths);

  bool empty() const { return paths_.empty(); }
  /// They end at their arrivals.
  const std::vector<Path>& paths() const { return paths_; }
  /// The step from which on nothing changes any more.
  std::uint32_t lastStep() const;
  /// The same, counted from a later step.
  Reservations from(std::uint32_t step) const;
  /// Why no plan can keep them: a robot's start or goal is taken for good; empty: that is not so.
  std::string findBlocked(const Instance& instance) const;

 private:
  std::vector<Path> paths_;
};

/// Says what a plan that keeps reservations is checked by: the independent validator on the plan
/// with the reserved paths as further robots. Empty: the plan is valid and keeps them.
std::string findViolation(const Instance& instance, const Plan& plan, const Reservations& reserved);

}  // namespace split_mapf
