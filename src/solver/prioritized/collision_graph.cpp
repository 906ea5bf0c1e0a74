#include "solver/prioritized/collision_graph.h"

#include <algorithm>

namespace split_mapf {

void CollisionGraph::connect(std::uint32_t robot, const std::vector<std::uint32_t>& others) {
  for (const std::uint32_t other : others) {
    addTo(robot, other);
    addTo(other, robot);
  }
  pairs_ += others.size();
}

void CollisionGraph::isolate(std::uint32_t robot) {
  if (others_[robot].empty()) return;
  pairs_ -= others_[robot].size();
  for (const std::uint32_t other : others_[robot]) {
    std::vector<std::uint32_t>& back = others_[other];
    back.erase(std::find(back.begin(), back.end(), robot));
    if (back.empty()) drop(other);
  }
  others_[robot].clear();
  drop(robot);
}

void CollisionGraph::addTo(std::uint32_t robot, std::uint32_t other) {
  if (others_[robot].empty()) {
    place_[robot] = static_cast<std::uint32_t>(colliding_.size());
    colliding_.push_back(robot);
  }
  others_[robot].push_back(other);
}

void CollisionGraph::drop(std::uint32_t robot) {
  const std::uint32_t last = colliding_.back();
  colliding_[place_[robot]] = last;
  place_[last] = place_[robot];
  colliding_.pop_back();
  place_[robot] = kNowhere;
}

}  // namespace split_mapf
