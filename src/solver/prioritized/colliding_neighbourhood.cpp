#include "solver/prioritized/colliding_neighbourhood.h"

#include <algorithm>

namespace split_mapf {
namespace {

constexpr std::uint32_t kNobody = 0xffffffffU;

}  // namespace

CollidingNeighbourhoodPicker::CollidingNeighbourhoodPicker(const Instance& instance,
                                                           std::uint64_t seed)
    : instance_(instance),
      engine_(seed),
      at_goal_(instance.graph().size(), kNobody),
      marks_(instance.robots(), 0) {
  for (std::uint32_t i = 0; i < instance.robots(); ++i) at_goal_[instance.goal(i)] = i;
}

void CollidingNeighbourhoodPicker::reward(std::uint64_t gain, std::uint64_t expansions) {
  const double rate = gainRate(gain, expansions);
  ways_.reward(rate);
  sizes_.reward(rate);
}

bool CollidingNeighbourhoodPicker::add(std::uint32_t robot, std::vector<std::uint32_t>& robots) {
  if (marks_[robot] == pick_number_ || robots.size() >= size_) return false;
  marks_[robot] = pick_number_;
  robots.push_back(robot);
  return true;
}

void CollidingNeighbourhoodPicker::takeCollisions(const CollisionGraph& graph,
                                                  std::vector<std::uint32_t>& robots) {
  // Across the collisions from robot to robot, as far as the size goes.
  constexpr int kMostSteps = 100;
  std::uint32_t at = robots.front();
  for (int step = 0; step < kMostSteps && robots.size() < size_; ++step) {
    if (graph.others(at).empty()) return;
    at = draw(graph.others(at));
    add(at, robots);
  }
}

void CollidingNeighbourhoodPicker::takeOccupants(const PathTable& table, Vertex v,
                                                 std::uint32_t from, std::uint32_t to,
                                                 std::vector<std::uint32_t>& robots) {
  for (const Stay& stay : table.at(v)) {
    if (stay.begin > to) return;
    if (stay.end > from) add(stay.robot, robots);
  }
}

void CollidingNeighbourhoodPicker::takeAtEnds(const Path& path, const PathTable& table,
                                              std::vector<std::uint32_t>& robots) {
  // Whose goals lie on its way, who passes its start, who passes its goal.
  std::vector<std::uint32_t> candidates;
  for (const Vertex v : path) {
    if (at_goal_[v] != kNobody) candidates.push_back(at_goal_[v]);
  }
  for (const Stay& stay : table.at(path.front())) candidates.push_back(stay.robot);
  for (const Stay& stay : table.at(path.back())) candidates.push_back(stay.robot);
  shuffle(candidates, engine_);
  for (const std::uint32_t robot : candidates) add(robot, robots);
}

void CollidingNeighbourhoodPicker::walk(const Path& path, const PathTable& table,
                                        std::vector<std::uint32_t>& robots) {
  constexpr int kMostSteps = 30;
  auto t = static_cast<std::uint32_t>(drawBelow(engine_, path.size()));
  Vertex at = path[t];
  for (int step = 0; step < kMostSteps && robots.size() < size_; ++step, ++t) {
    Vertex next = at;  // waits, or moves
    std::uint64_t choices = 1;
    for (const Vertex v : instance_.graph().neighbours(at)) {
      if (drawBelow(engine_, ++choices) == 0) next = v;
    }
    at = next;
    takeOccupants(table, at, t, t + 1, robots);
  }
}

void CollidingNeighbourhoodPicker::pick(const std::vector<Path>& paths, const PathTable& table,
                                        const CollisionGraph& graph,
                                        std::vector<std::uint32_t>& robots) {
  robots.clear();
  ++pick_number_;
  const std::size_t way = ways_.draw(engine_);
  size_ = std::min<std::size_t>(kSizes[sizes_.draw(engine_)], instance_.robots());
  add(draw(graph.colliding()), robots);
  if (way == kCollisions) takeCollisions(graph, robots);
  if (way == kEnds) takeAtEnds(paths[robots.front()], table, robots);
  if (way == kRandom) {
    while (robots.size() < size_) {
      add(static_cast<std::uint32_t>(drawBelow(engine_, instance_.robots())), robots);
    }
  }
  constexpr int kWalks = 10;
  for (int i = 0; i < kWalks && robots.size() < size_; ++i) {
    walk(paths[draw(robots)], table, robots);
  }
  shuffle(robots, engine_);
}

}  // namespace split_mapf
