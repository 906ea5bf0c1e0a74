#include "solver/lacam/scatter_search.h"

#include <algorithm>

namespace split_mapf {
namespace {

// A collision is worth a detour of so many steps.
constexpr std::uint32_t kCollisionSteps = 8;

}  // namespace

Crossings::Crossings(const Graph& graph)
    : graph_(graph), visits_(graph.size()), ended_(graph.size(), kNever) {}

std::uint32_t Crossings::keyOf(Vertex from, Vertex to, std::uint32_t t) const {
  std::uint32_t direction = 0;
  for (const Vertex u : graph_.neighbours(to)) {
    if (u == from) break;
    ++direction;
  }
  return t << kFromBits | direction;
}

template <typename Change>
void Crossings::visit(const Path& path, Change change) const {
  for (std::uint32_t t = 1; t < path.size(); ++t) {
    change(path[t], keyOf(path[t - 1], path[t], t));
  }
}

void Crossings::insert(const Path& path) {
  visit(path, [this](Vertex v, std::uint32_t key) {
    std::vector<std::uint32_t>& visits = visits_[v];
    visits.insert(std::upper_bound(visits.begin(), visits.end(), key), key);
  });
  if (!path.empty()) ended_[path.back()] = static_cast<std::uint32_t>(path.size() - 1);
}

void Crossings::remove(const Path& path) {
  visit(path, [this](Vertex v, std::uint32_t key) {
    std::vector<std::uint32_t>& visits = visits_[v];
    visits.erase(std::lower_bound(visits.begin(), visits.end(), key));
  });
  if (!path.empty()) ended_[path.back()] = kNever;
}

template <typename Found>
void Crossings::forEachAt(Vertex v, std::uint32_t t, Found found) const {
  const std::vector<std::uint32_t>& keys = visits_[v];
  auto key = std::lower_bound(keys.begin(), keys.end(), t << kFromBits);
  for (; key != keys.end() && *key >> kFromBits == t; ++key) found(*key);
}

std::array<std::uint32_t, Crossings::kDirections> Crossings::arrivals(Vertex v,
                                                                      std::uint32_t t) const {
  std::array<std::uint32_t, kDirections> counts{};
  forEachAt(v, t, [&counts](std::uint32_t key) { ++counts[key % kDirections]; });
  return counts;
}

std::uint32_t Crossings::count(Vertex v, std::uint32_t t) const {
  std::uint32_t count = ended_[v] < t ? 1 : 0;
  forEachAt(v, t, [&count](std::uint32_t) { ++count; });
  return count;
}

ScatterSearch::ScatterSearch(const Instance& instance, const Crossings& table, std::uint32_t margin)
    : instance_(instance), table_(table), margin_(margin), closed_(instance.graph().size(), 0) {}

Path ScatterSearch::find(std::uint32_t robot) {
  const HeldDistances distances = instance_.distances(robot);
  distances_ = &*distances;
  shortest_ = instance_.shortestLength(robot);
  ++search_number_;
  expansions_ = 0;
  queue_.clear();
  constexpr std::uint32_t kNone = BucketQueue<State>::kNoState;
  queue_.push({instance_.start(robot), 0, 0, kNone, kNone}, 0);
  while (!queue_.empty()) {
    const std::uint32_t index = queue_.pop();
    const State& state = queue_[index];
    if (closed_[state.vertex] == search_number_) continue;
    if (state.vertex == instance_.goal(robot)) {
      collisions_ = state.collisions;
      return queue_.pathTo(index);
    }
    closed_[state.vertex] = search_number_;
    expand(index);
  }
  return {};
}

void ScatterSearch::expand(std::uint32_t index) {
  ++expansions_;
  const State state = queue_[index];
  const std::uint32_t arrival = state.time + 1;
  // Who comes here from where the robot goes runs into it.
  const std::array<std::uint32_t, Crossings::kDirections> oncoming =
      table_.arrivals(state.vertex, arrival);
  std::size_t direction = 0;
  for (const Vertex u : instance_.graph().neighbours(state.vertex)) {
    const std::uint32_t meets = oncoming[direction++];
    if (closed_[u] == search_number_) continue;
    const std::uint32_t length = arrival + (*distances_)(u);
    if (length > shortest_ + margin_) continue;
    const std::uint32_t collisions = state.collisions + meets + table_.count(u, arrival);
    queue_.push({u, arrival, collisions, index, BucketQueue<State>::kNoState},
                std::size_t{collisions} * kCollisionSteps + length - shortest_);
  }
}

}  // namespace split_mapf
