#include "split/narrow_borders.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "split/region_repair.h"

namespace split_mapf {
namespace {

/// A flow network between two terminals, whose paths carry one unit each.
class Network {
 public:
  static constexpr std::uint32_t kSource = 0;
  static constexpr std::uint32_t kSink = 1;

  explicit Network(std::size_t nodes) : arcs_(nodes) {}

  void join(std::uint32_t a, std::uint32_t b, std::uint32_t capacity) {
    arcs_[a].push_back({b, capacity, static_cast<std::uint32_t>(arcs_[b].size())});
    arcs_[b].push_back({a, capacity, static_cast<std::uint32_t>(arcs_[a].size()) - 1});
  }

  /// Sends as much as gets through (Edmonds and Karp 1972).
  void fill() {
    while (search(kSource, true)) {
      for (std::uint32_t node = kSink; node != kSource;) {
        Arc& back = arcs_[node][arrival_[node]];
        ++back.capacity;
        --arcs_[back.to][back.reverse].capacity;
        node = back.to;
      }
    }
  }

  /// After fill(): the nodes that the source reaches, or those that reach the sink.
  std::vector<bool> sideOf(std::uint32_t terminal) {
    search(terminal, terminal == kSource);
    return seen_;
  }

 private:
  struct Arc {
    std::uint32_t to;
    std::uint32_t capacity;
    std::uint32_t reverse;  // place of the opposite arc in its node's list
  };

  /// Breadth first along (or against) arcs with capacity; whether the other terminal was met.
  bool search(std::uint32_t from, bool along) {
    seen_.assign(arcs_.size(), false);
    arrival_.assign(arcs_.size(), 0);
    queue_.assign(1, from);
    seen_[from] = true;
    for (std::size_t head = 0; head < queue_.size() && !(along && seen_[kSink]); ++head) {
      for (const Arc& arc : arcs_[queue_[head]]) {
        const std::uint32_t left = along ? arc.capacity : arcs_[arc.to][arc.reverse].capacity;
        if (left == 0 || seen_[arc.to]) continue;
        seen_[arc.to] = true;
        arrival_[arc.to] = arc.reverse;
        queue_.push_back(arc.to);
      }
    }
    return seen_[kSink];
  }

  std::vector<std::vector<Arc>> arcs_;
  std::vector<bool> seen_;
  std::vector<std::uint32_t> arrival_;  // place of the arc back to where a node was met from
  std::vector<std::uint32_t> queue_;
};

// A region gives or takes at most this share of its cells at one border.
constexpr std::uint32_t kBandShare = 4;

/// The band around the border of two regions, and its narrowest cut.
class Band {
 public:
  Band(const Graph& graph, const Units& units, const Ownership& ownership, std::uint32_t left,
       std::uint32_t right)
      : graph_(graph), units_(units), ownership_(ownership), left_(left), right_(right) {}

  /// Cells of both regions, each with the one that should own it; empty where the regions are too
  /// small for a band.
  std::vector<std::pair<Vertex, std::uint32_t>> cut() {
    const auto first = grow(left_, right_);
    const auto second = grow(right_, left_);
    if (first.empty() || second.empty()) return {};
    for (const std::vector<Vertex>& side : {first, second}) {
      for (const Vertex v : side) {
        node_.emplace(units_.unit_of[v], static_cast<std::uint32_t>(2 + node_.size()));
      }
    }
    Network network(2 + node_.size());
    for (const std::vector<Vertex>& side : {first, second}) connect(side, network);
    network.fill();
    return takeSides(first, second, network);
  }

 private:
  /// Whole units of a region around its border with the other one, nearest first.
  std::vector<Vertex> grow(std::uint32_t region, std::uint32_t other) const {
    std::vector<bool> seen(graph_.size(), false);
    std::vector<Vertex> band;
    std::size_t cells = 0;
    const auto take = [&](Vertex v) {
      if (seen[v] || ownership_[v] != region) return;
      for (const Vertex member : units_.members[units_.unit_of[v]]) {
        seen[member] = true;
        band.push_back(member);
      }
    };
    for (Vertex v = 0; v < graph_.size(); ++v) {
      cells += ownership_[v] == region ? 1 : 0;
      for (const Vertex u : graph_.neighbours(v)) {
        if (ownership_[v] == region && ownership_[u] == other) take(v);
      }
    }
    for (std::size_t head = 0; head < band.size() && band.size() * kBandShare < cells; ++head) {
      for (const Vertex u : graph_.neighbours(band[head])) take(u);
    }
    return band.size() * 2 < cells ? band : std::vector<Vertex>();
  }

  void connect(const std::vector<Vertex>& side, Network& network) const {
    constexpr std::uint32_t kSolid = 1U << 30;
    for (const Vertex v : side) {
      const std::uint32_t from = node_.at(units_.unit_of[v]);
      for (const Vertex u : graph_.neighbours(v)) {
        if (units_.unit_of[u] == units_.unit_of[v]) continue;
        const auto inside = node_.find(units_.unit_of[u]);
        if (inside != node_.end()) {
          if (v < u) network.join(from, inside->second, 1);
        } else if (ownership_[u] == left_) {
          network.join(Network::kSource, from, kSolid);
        } else if (ownership_[u] == right_) {
          network.join(from, Network::kSink, kSolid);
        }
      }
    }
  }

  std::vector<std::pair<Vertex, std::uint32_t>> takeSides(const std::vector<Vertex>& first,
                                                          const std::vector<Vertex>& second,
                                                          Network& network) const {
    const std::vector<bool> with_left = network.sideOf(Network::kSource);
    const std::vector<bool> with_right = network.sideOf(Network::kSink);
    std::int64_t surplus = 0;  // of the left region over the right one
    for (const std::uint32_t owner : ownership_) {
      surplus += owner == left_ ? 1 : 0;
      surplus -= owner == right_ ? 1 : 0;
    }
    std::int64_t near = surplus;
    std::int64_t far = surplus;
    std::vector<std::pair<Vertex, std::uint32_t>> near_sides;
    std::vector<std::pair<Vertex, std::uint32_t>> far_sides;
    for (const std::vector<Vertex>& side : {first, second}) {
      for (const Vertex v : side) {
        const std::uint32_t node = node_.at(units_.unit_of[v]);
        near_sides.emplace_back(v, with_left[node] ? left_ : right_);
        far_sides.emplace_back(v, with_right[node] ? right_ : left_);
        near += shift(v, near_sides.back().second);
        far += shift(v, far_sides.back().second);
      }
    }
    return std::abs(near) <= std::abs(far) ? near_sides : far_sides;
  }

  std::int64_t shift(Vertex v, std::uint32_t owner) const {
    if (ownership_[v] == owner) return 0;
    return owner == left_ ? 2 : -2;
  }

  const Graph& graph_;
  const Units& units_;
  const Ownership& ownership_;
  std::uint32_t left_;
  std::uint32_t right_;
  std::unordered_map<std::uint32_t, std::uint32_t> node_;  // by unit
};

}  // namespace

void narrowBorders(const Graph& graph, const Units& units, Ownership& ownership) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> borders;
  for (Vertex v = 0; v < graph.size(); ++v) {
    for (const Vertex u : graph.neighbours(v)) {
      if (ownership[v] < ownership[u]) borders.emplace(ownership[v], ownership[u]);
    }
  }
  for (const auto& [left, right] : borders) {
    for (const auto& [v, owner] : Band(graph, units, ownership, left, right).cut()) {
      ownership[v] = owner;
    }
  }
  connectRegions(graph, ownership);
}

}  // namespace split_mapf
