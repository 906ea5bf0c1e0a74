#pragma once

#include <cstdint>
#include <vector>

namespace split_mapf {

/// Which robots collide with which. Cost of a change: the robot's pairs, times those of the others.
class CollisionGraph {
 public:
  explicit CollisionGraph(std::uint32_t robots) : others_(robots), place_(robots, kNowhere) {}

  /// @pre the robot collides with nobody so far.
  void connect(std::uint32_t robot, const std::vector<std::uint32_t>& others);
  /// Takes all its collisions away.
  void isolate(std::uint32_t robot);

  std::uint64_t pairs() const { return pairs_; }
  const std::vector<std::uint32_t>& others(std::uint32_t robot) const { return others_[robot]; }
  /// All robots with a collision, in an order that only past changes decide.
  const std::vector<std::uint32_t>& colliding() const { return colliding_; }

 private:
  static constexpr std::uint32_t kNowhere = 0xffffffffU;
  void addTo(std::uint32_t robot, std::uint32_t other);
  void drop(std::uint32_t robot);

  std::vector<std::vector<std::uint32_t>> others_;
  std::vector<std::uint32_t> place_;  // of a robot in colliding_
  std::vector<std::uint32_t> colliding_;
  std::uint64_t pairs_ = 0;
};

}  // namespace split_mapf
