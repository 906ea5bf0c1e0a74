#pragma once

#include <cstdint>
#include <vector>

#include "solver/ilp/moves.h"
#include "split_mapf/core/instance.h"

namespace split_mapf::ilp {

/// Where one robot can be and when, if it arrives by a given step: the vertices v with
/// d(start, v) + d(v, goal) <= latest arrival, each from step first = d(start, v) to step
/// last = latest arrival - d(v, goal). In order of `first`. Built by one search from the start that
/// never leaves the window.
class Window {
 public:
  static constexpr std::uint32_t kNowhere = 0xffffffffU;

  /// @pre the robot's shortest length <= latest_arrival.
  Window(const Instance& instance, std::uint32_t robot, std::uint32_t latest_arrival,
         std::uint32_t slots);

  std::uint32_t latestArrival() const { return latest_arrival_; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(vertices_.size()); }
  Vertex vertex(std::uint32_t place) const { return vertices_[place]; }
  std::uint32_t first(std::uint32_t place) const { return first_[place]; }
  std::uint32_t last(std::uint32_t place) const { return last_[place]; }
  /// Place of the goal; the start's is 0.
  std::uint32_t goalPlace() const { return goal_place_; }
  /// The places from which a move can arrive, by slot of MoveSpace; kNowhere outside the window.
  const std::uint32_t* sources(std::uint32_t place) const {
    return sources_.data() + std::size_t{place} * slots_;
  }

 private:
  std::uint32_t latest_arrival_;
  std::uint32_t slots_;
  std::uint32_t goal_place_ = 0;
  std::vector<Vertex> vertices_;
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> last_;
  std::vector<std::uint32_t> sources_;
};

}  // namespace split_mapf::ilp
