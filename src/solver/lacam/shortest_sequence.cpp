#include "solver/lacam/shortest_sequence.h"

#include <algorithm>
#include <functional>
#include <queue>

namespace split_mapf {
namespace {

constexpr std::uint64_t kInfinite = ~std::uint64_t{0};

/// Moves out of each configuration, in compressed form.
struct Successors {
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> to;
};

Successors successorsOf(const ExploredMoves& moves) {
  const std::size_t nodes = moves.parents.size();
  Successors successors{std::vector<std::uint32_t>(nodes + 1, 0), {}};
  const auto each = [&](const auto& call) {
    for (std::uint32_t n = 1; n < nodes; ++n) call(moves.parents[n], n);
    for (const auto& [from, to] : moves.shortcuts) call(from, to);
  };
  each([&](std::uint32_t from, std::uint32_t) { ++successors.first[from + 1]; });
  for (std::size_t n = 0; n < nodes; ++n) successors.first[n + 1] += successors.first[n];
  successors.to.resize(successors.first[nodes]);
  std::vector<std::uint32_t> place(successors.first.begin(), successors.first.end() - 1);
  each([&](std::uint32_t from, std::uint32_t to) { successors.to[place[from]++] = to; });
  return successors;
}

std::uint64_t costOfMove(const Instance& instance, const Configuration& from,
                         const Configuration& to) {
  std::uint64_t cost = 0;
  for (std::uint32_t i = 0; i < from.size(); ++i) {
    cost += from[i] != instance.goal(i) || to[i] != instance.goal(i) ? 1 : 0;
  }
  return cost;
}

std::vector<std::uint32_t> upTo(std::uint32_t goal, const std::vector<std::uint32_t>& parents) {
  std::vector<std::uint32_t> sequence{goal};
  while (sequence.back() != 0) sequence.push_back(parents[sequence.back()]);
  std::reverse(sequence.begin(), sequence.end());
  return sequence;
}

}  // namespace

std::vector<std::uint32_t> shortestSequence(const Instance& instance, const ExploredMoves& moves,
                                            std::uint32_t goal, Objective objective) {
  if (moves.shortcuts.empty()) return upTo(goal, moves.parents);
  const Successors successors = successorsOf(moves);
  std::vector<std::uint64_t> costs(moves.parents.size(), kInfinite);
  std::vector<std::uint32_t> parents(moves.parents.size(), 0);
  using Entry = std::pair<std::uint64_t, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  costs[0] = 0;
  open.emplace(0, 0);
  Configuration from;
  Configuration to;
  while (!open.empty() && open.top().second != goal) {
    const auto [cost, node] = open.top();
    open.pop();
    if (cost > costs[node]) continue;
    if (ruleOf(objective).sums()) moves.explored.read(node, from);
    for (std::uint32_t k = successors.first[node]; k < successors.first[node + 1]; ++k) {
      const std::uint32_t next = successors.to[k];
      std::uint64_t step = 1;
      if (ruleOf(objective).sums()) {
        moves.explored.read(next, to);
        step = costOfMove(instance, from, to);
      }
      if (cost + step >= costs[next]) continue;
      costs[next] = cost + step;
      parents[next] = node;
      open.emplace(costs[next], next);
    }
  }
  return upTo(goal, parents);
}

}  // namespace split_mapf
