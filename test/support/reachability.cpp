#include "support/reachability.h"

#include <algorithm>
#include <stdexcept>

namespace split_mapf::test {
namespace {

constexpr std::uint8_t kEmpty = 0xff;

std::uint32_t bitsIn(std::uint32_t mask) {
  std::uint32_t count = 0;
  for (; mask != 0; mask &= mask - 1) ++count;
  return count;
}

}  // namespace

Reachability::Reachability(const Graph& graph, const std::vector<Vertex>& starts, StepKind steps)
    : graph_(graph) {
  std::uint64_t arrangements = 1;
  for (std::uint32_t i = 0; i < starts.size(); ++i) arrangements *= graph.size() - i;
  if (graph.size() > 15 || arrangements > 10000000) {
    throw std::invalid_argument("too large for exhaustive search");
  }
  reached_.assign(arrangements, false);
  for (Vertex v = 0; v < graph.size(); ++v) {
    std::vector<std::uint8_t> path = {static_cast<std::uint8_t>(v)};
    findCycles(path);
  }
  visit(Arrangement(starts.begin(), starts.end()));
  while (!open_.empty()) {
    const Arrangement arrangement = std::move(open_.back());
    open_.pop_back();
    if (steps == StepKind::kElementary) {
      stepElementary(arrangement);
    } else {
      Arrangement next;
      stepSynchronously(arrangement, next);
    }
  }
}

bool Reachability::reaches(const std::vector<Vertex>& goals) const {
  return reached_[indexOf(Arrangement(goals.begin(), goals.end()))];
}

/// Robot by robot: how many vertices free of earlier robots come before its own.
std::uint64_t Reachability::indexOf(const Arrangement& arrangement) const {
  std::uint32_t free = (1U << graph_.size()) - 1;
  std::uint32_t choices = graph_.size();
  std::uint64_t index = 0;
  for (const std::uint8_t v : arrangement) {
    index = index * choices-- + bitsIn(free & ((1U << v) - 1));
    free &= ~(1U << v);
  }
  return index;
}

/// Extends a path by vertices greater than its first, which makes each cycle start at its least.
void Reachability::findCycles(std::vector<std::uint8_t>& path) {
  if (path.size() >= 3 && graph_.adjacent(path.back(), path.front())) cycles_.push_back(path);
  for (const Vertex v : graph_.neighbours(path.back())) {
    if (v <= path.front() || std::find(path.begin(), path.end(), v) != path.end()) continue;
    path.push_back(static_cast<std::uint8_t>(v));
    findCycles(path);
    path.pop_back();
  }
}

void Reachability::visit(const Arrangement& arrangement) {
  const std::uint64_t index = indexOf(arrangement);
  if (reached_[index]) return;
  reached_[index] = true;
  ++count_;
  open_.push_back(arrangement);
}

void Reachability::stepElementary(const Arrangement& arrangement) {
  std::vector<std::uint8_t> robot_at(graph_.size(), kEmpty);
  for (std::size_t robot = 0; robot < arrangement.size(); ++robot) {
    robot_at[arrangement[robot]] = static_cast<std::uint8_t>(robot);
  }
  Arrangement next = arrangement;
  for (std::size_t robot = 0; robot < arrangement.size(); ++robot) {
    for (const Vertex v : graph_.neighbours(arrangement[robot])) {
      if (robot_at[v] != kEmpty) continue;
      next[robot] = static_cast<std::uint8_t>(v);
      visit(next);
    }
    next[robot] = arrangement[robot];
  }
  for (const std::vector<std::uint8_t>& cycle : cycles_) {
    const auto is_empty = [&](std::uint8_t v) { return robot_at[v] == kEmpty; };
    if (std::any_of(cycle.begin(), cycle.end(), is_empty)) continue;
    next = arrangement;
    for (std::size_t i = 0; i < cycle.size(); ++i) {
      next[robot_at[cycle[i]]] = cycle[(i + 1) % cycle.size()];
    }
    visit(next);
  }
}

/// Chooses where the robots behind those of `next` go, in every legal way.
void Reachability::stepSynchronously(const Arrangement& arrangement, Arrangement& next) {
  const std::size_t robot = next.size();
  if (robot == arrangement.size()) {
    visit(next);
    return;
  }
  const auto try_vertex = [&](Vertex v) {
    for (std::size_t other = 0; other < robot; ++other) {
      const bool is_taken = next[other] == v;
      const bool is_swap = next[other] == arrangement[robot] && arrangement[other] == v;
      if (is_taken || is_swap) return;
    }
    next.push_back(static_cast<std::uint8_t>(v));
    stepSynchronously(arrangement, next);
    next.pop_back();
  };
  try_vertex(arrangement[robot]);
  for (const Vertex v : graph_.neighbours(arrangement[robot])) try_vertex(v);
}

}  // namespace split_mapf::test
