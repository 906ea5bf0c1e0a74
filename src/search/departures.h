#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// The steps until which robots stay at their starts, whatever is planned for them: who stands now
/// is known to stand on. All 0 unless said otherwise.
class Departures {
 public:
  Departures() = default;
  explicit Departures(std::vector<std::uint32_t> steps) : steps_(std::move(steps)) {}

  bool any() const { return !steps_.empty(); }
  std::uint32_t operator()(std::uint32_t robot) const { return any() ? steps_[robot] : 0; }
  /// Whether a robot that stays at its goal must not even move aside and come back.
  bool holds(std::uint32_t robot, const Path& path) const { return path.size() <= (*this)(robot); }
  /// The step at which a robot arrives when no other is in its way. @pre it is not cut off.
  std::uint32_t soonestArrival(const Instance& instance, std::uint32_t robot) const {
    const std::uint32_t shortest = instance.shortestLength(robot);
    return shortest > 0 ? (*this)(robot) + shortest : 0;
  }
  /// Of every robot.
  std::vector<std::uint32_t> soonestArrivals(const Instance& instance) const {
    std::vector<std::uint32_t> steps(instance.robots());
    for (std::uint32_t robot = 0; robot < steps.size(); ++robot) {
      steps[robot] = soonestArrival(instance, robot);
    }
    return steps;
  }

 private:
  std::vector<std::uint32_t> steps_;
};

}  // namespace split_mapf
