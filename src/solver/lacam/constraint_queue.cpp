#include "solver/lacam/constraint_queue.h"

#include <algorithm>

namespace split_mapf {

bool ConstraintQueue::pop(const Graph& graph, const Configuration& from,
                          const std::vector<std::uint32_t>& order, RandomEngine& engine,
                          Configuration& next) {
  while (tried_ > sets_.size()) {
    if (branched_ > sets_.size()) return false;
    branch(branched_++, graph, from, order, engine);
  }
  std::fill(next.begin(), next.end(), kNoVertex);
  for (std::uint32_t n = tried_++; n != kRoot; n = sets_[n - 1].parent) {
    next[order[sets_[n - 1].depth]] = sets_[n - 1].place;
  }
  return true;
}

void ConstraintQueue::branch(std::uint32_t number, const Graph& graph, const Configuration& from,
                             const std::vector<std::uint32_t>& order, RandomEngine& engine) {
  const std::uint32_t depth = number == kRoot ? 0 : sets_[number - 1].depth + 1;
  if (depth == order.size()) return;
  const std::uint32_t robot = order[depth];
  std::vector<Vertex> places(graph.neighbours(from[robot]).begin(),
                             graph.neighbours(from[robot]).end());
  places.push_back(from[robot]);
  shuffle(places, engine);
  for (const Vertex place : places) {
    if (allows(number, from, order, robot, place)) sets_.push_back({number, depth, place});
  }
}

bool ConstraintQueue::allows(std::uint32_t number, const Configuration& from,
                             const std::vector<std::uint32_t>& order, std::uint32_t robot,
                             Vertex place) const {
  for (std::uint32_t n = number; n != kRoot; n = sets_[n - 1].parent) {
    const Set& set = sets_[n - 1];
    if (set.place == place) return false;
    if (set.place == from[robot] && place == from[order[set.depth]]) return false;
  }
  return true;
}

}  // namespace split_mapf
