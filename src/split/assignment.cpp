#include "split/assignment.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <queue>
#include <unordered_map>
#include <utility>

#include <boost/pending/disjoint_sets.hpp>

namespace split_mapf {
namespace {

using Robots = std::vector<std::uint32_t>;
using Candidates = std::vector<std::vector<Candidate>>;

/// Robots that are linked through candidates they share.
std::vector<Robots> groupsOf(const Candidates& candidates) {
  const auto robots = static_cast<std::uint32_t>(candidates.size());
  std::vector<std::uint32_t> rank(robots, 0);
  std::vector<std::uint32_t> parent(robots);
  boost::disjoint_sets<std::uint32_t*, std::uint32_t*> sets(rank.data(), parent.data());
  std::unordered_map<Vertex, std::uint32_t> first_with;
  for (std::uint32_t i = 0; i < robots; ++i) sets.make_set(i);
  for (std::uint32_t i = 0; i < robots; ++i) {
    for (const Candidate& candidate : candidates[i]) {
      const auto known = first_with.emplace(candidate.vertex, i);
      if (!known.second) sets.union_set(i, known.first->second);
    }
  }
  std::vector<Robots> by_root(robots);
  for (std::uint32_t i = 0; i < robots; ++i) by_root[sets.find_set(i)].push_back(i);
  by_root.erase(std::remove_if(by_root.begin(), by_root.end(),
                               [](const Robots& group) { return group.empty(); }),
                by_root.end());
  return by_root;
}

/// The assignment of one group: a minimum-cost flow from robots to vertices, one robot after
/// another along a shortest augmenting path (Jonker and Volgenant 1987, on sparse lists). Searches
/// end at the first free vertex, so they stay small where there is room. Every robot also has a
/// place of its own outside, so dear that it is taken only when no vertex is left.
class GroupFlow {
 public:
  GroupFlow(const Robots& group, const Candidates& candidates) : group_(group) {
    std::unordered_map<Vertex, std::uint32_t> number;
    arcs_.resize(group.size());
    for (std::size_t row = 0; row < group.size(); ++row) {
      for (const Candidate& candidate : candidates[group[row]]) {
        const auto known =
            number.emplace(candidate.vertex, static_cast<std::uint32_t>(vertices_.size()));
        if (known.second) vertices_.push_back(candidate.vertex);
        arcs_[row].push_back({known.first->second, candidate.cost});
      }
    }
    for (std::size_t row = 0; row < group.size(); ++row) {
      arcs_[row].push_back({static_cast<std::uint32_t>(vertices_.size()), kOutside});
      vertices_.push_back(kNoVertex);
    }
    price_.assign(vertices_.size(), 0);
    taken_by_.assign(vertices_.size(), kNobody);
    taken_cost_.assign(vertices_.size(), 0);
    distance_.assign(vertices_.size(), kInfinite);
    reached_from_.assign(vertices_.size(), kNobody);
    arc_cost_.assign(vertices_.size(), 0);
  }

  void solve(std::vector<Vertex>& assigned) {
    for (std::uint32_t row = 0; row < group_.size(); ++row) augmentFrom(row);
    for (std::size_t column = 0; column < vertices_.size(); ++column) {
      if (taken_by_[column] != kNobody) assigned[group_[taken_by_[column]]] = vertices_[column];
    }
  }

 private:
  static constexpr std::uint32_t kNobody = 0xffffffffU;
  static constexpr std::int64_t kOutside = std::int64_t{1} << 40;
  static constexpr std::int64_t kInfinite = std::int64_t{1} << 60;

  struct Arc {
    std::uint32_t column;
    std::int64_t cost;
  };
  using Entry = std::pair<std::int64_t, std::uint32_t>;  // distance, column

  void relax(std::uint32_t row, std::int64_t base) {
    for (const Arc& arc : arcs_[row]) {
      const std::int64_t distance = base + arc.cost - price_[arc.column];
      if (distance >= distance_[arc.column]) continue;
      if (distance_[arc.column] == kInfinite) met_.push_back(arc.column);
      distance_[arc.column] = distance;
      reached_from_[arc.column] = row;
      arc_cost_[arc.column] = arc.cost;
      open_.emplace(distance, arc.column);
    }
  }

  void augmentFrom(std::uint32_t root) {
    relax(root, 0);
    std::vector<std::uint32_t> closed;
    std::uint32_t column = 0;
    for (;;) {
      const Entry entry = open_.top();
      open_.pop();
      column = entry.second;
      if (entry.first > distance_[column]) continue;
      if (taken_by_[column] == kNobody) break;
      closed.push_back(column);
      relax(taken_by_[column], entry.first - taken_cost_[column] + price_[column]);
    }
    const std::int64_t shortest = distance_[column];
    for (const std::uint32_t c : closed) price_[c] += distance_[c] - shortest;
    // Each robot on the way takes the vertex that it was reached by, and frees its own.
    for (std::uint32_t row = kNobody; row != root;) {
      row = reached_from_[column];
      const std::uint32_t freed = columnOf(row);
      taken_by_[column] = row;
      taken_cost_[column] = arc_cost_[column];
      column = freed;
    }
    for (const std::uint32_t c : met_) distance_[c] = kInfinite;
    met_.clear();
    open_ = {};
  }

  std::uint32_t columnOf(std::uint32_t row) const {
    for (const Arc& arc : arcs_[row]) {
      if (taken_by_[arc.column] == row) return arc.column;
    }
    return kNobody;
  }

  const Robots& group_;
  std::vector<Vertex> vertices_;
  std::vector<std::vector<Arc>> arcs_;
  std::vector<std::int64_t> price_;
  std::vector<std::uint32_t> taken_by_;
  std::vector<std::int64_t> taken_cost_;
  // Of the search that is under way.
  std::vector<std::int64_t> distance_;
  std::vector<std::uint32_t> reached_from_;
  std::vector<std::int64_t> arc_cost_;
  std::vector<std::uint32_t> met_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
};

}  // namespace

std::vector<Vertex> assignAtLeastCost(const std::vector<std::vector<Candidate>>& candidates) {
  std::vector<Vertex> assigned(candidates.size(), kNoVertex);
  for (const Robots& group : groupsOf(candidates)) {
    if (group.size() == 1) {
      const std::vector<Candidate>& own = candidates[group.front()];
      if (own.empty()) continue;
      assigned[group.front()] =
          std::min_element(own.begin(), own.end(), [](const Candidate& a, const Candidate& b) {
            return a.cost < b.cost;
          })->vertex;
    } else {
      GroupFlow(group, candidates).solve(assigned);
    }
  }
  return assigned;
}

}  // namespace split_mapf
