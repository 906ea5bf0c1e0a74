#include "split/balanced_regions.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <tuple>
#include <utility>

#include "split/region_repair.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kNoUnit = 0xffffffffU;
constexpr std::uint32_t kRounds = 12;
// What entering a cell of clearance 1 (a wall beside it) costs more than a step in the open.
constexpr double kNarrowCost = 12;

/// Steps from each cell to the nearest cell with a wall beside it, plus one.
std::vector<std::uint32_t> clearances(const Graph& graph) {
  constexpr std::uint32_t kOpen = 4;
  std::vector<std::uint32_t> clearance(graph.size(), 0);
  std::vector<Vertex> queue;
  for (Vertex v = 0; v < graph.size(); ++v) {
    if (graph.neighbours(v).size() == kOpen) continue;
    clearance[v] = 1;
    queue.push_back(v);
  }
  for (std::size_t head = 0; head < queue.size(); ++head) {
    for (const Vertex u : graph.neighbours(queue[head])) {
      if (clearance[u] != 0) continue;
      clearance[u] = clearance[queue[head]] + 1;
      queue.push_back(u);
    }
  }
  return clearance;
}

/// Grows the regions of one connected part of the map.
class Growth {
 public:
  Growth(const Grid& grid, const Units& units, const std::vector<std::uint32_t>& clearance,
         std::vector<Vertex> part)
      : grid_(grid), units_(units), clearance_(clearance), part_(std::move(part)) {}

  /// Writes regions first .. first+count-1 into `ownership`.
  void run(std::uint32_t count, std::uint32_t first, Ownership& ownership,
           std::vector<double>& distance) {
    std::vector<Vertex> centres = {part_.front()};
    head_start_.assign(1, 0);
    grow(centres, first, ownership, distance);
    // The first centre was anywhere: start from the cell farthest from it instead.
    centres[0] = farthest(distance);
    while (centres.size() < count) {
      head_start_.assign(centres.size(), 0);
      grow(centres, first, ownership, distance);
      centres.push_back(farthest(distance));
    }
    head_start_.assign(count, 0);
    for (std::uint32_t round = 0; round < kRounds; ++round) {
      grow(centres, first, ownership, distance);
      if (count == 1 || round + 1 == kRounds) break;
      balance(count, first, ownership, distance);
      if (round + 3 < kRounds) moveCentres(centres, first, ownership);
    }
  }

 private:
  using Entry = std::tuple<double, Vertex, std::uint32_t>;  // distance, cell, region

  double costOf(Vertex v) const {
    const double clearance = clearance_[v];
    return 1 + kNarrowCost / (clearance * clearance * clearance);
  }

  void grow(const std::vector<Vertex>& centres, std::uint32_t first, Ownership& ownership,
            std::vector<double>& distance) {
    for (const Vertex v : part_) ownership[v] = kNoRegion;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    for (std::uint32_t i = 0; i < centres.size(); ++i) {
      open.emplace(head_start_[i], centres[i], first + i);
    }
    while (!open.empty()) {
      const auto [reached, v, region] = open.top();
      open.pop();
      if (ownership[v] != kNoRegion) continue;
      for (const Vertex member : units_.members[units_.unit_of[v]]) {
        ownership[member] = region;
        distance[member] = reached;
        for (const Vertex u : grid_.graph().neighbours(member)) {
          if (ownership[u] == kNoRegion) open.emplace(reached + costOf(u), u, region);
        }
      }
    }
  }

  Vertex farthest(const std::vector<double>& distance) const {
    return *std::max_element(part_.begin(), part_.end(), [&](Vertex a, Vertex b) {
      return distance[a] != distance[b] ? distance[a] < distance[b] : a > b;
    });
  }

  /// Regions that are too large start later, those too small earlier.
  void balance(std::uint32_t count, std::uint32_t first, const Ownership& ownership,
               const std::vector<double>& distance) {
    std::vector<double> size(count, 0);
    double reach = 0;
    for (const Vertex v : part_) {
      ++size[ownership[v] - first];
      reach += distance[v];
    }
    reach /= static_cast<double>(part_.size());
    const double fair = static_cast<double>(part_.size()) / count;
    for (std::uint32_t i = 0; i < count; ++i) {
      head_start_[i] += 0.4 * reach * std::clamp(size[i] / fair - 1, -1.0, 1.0);
    }
    const double least = *std::min_element(head_start_.begin(), head_start_.end());
    for (double& start : head_start_) start -= least;
  }

  /// To the cell of each region that is nearest to the mean of its cells.
  void moveCentres(std::vector<Vertex>& centres, std::uint32_t first, const Ownership& ownership) {
    std::vector<double> x(centres.size(), 0);
    std::vector<double> y(centres.size(), 0);
    std::vector<double> cells(centres.size(), 0);
    for (const Vertex v : part_) {
      const std::uint32_t region = ownership[v] - first;
      x[region] += grid_.cellOf(v).x;
      y[region] += grid_.cellOf(v).y;
      ++cells[region];
    }
    std::vector<double> nearest(centres.size(), HUGE_VAL);
    for (const Vertex v : part_) {
      const std::uint32_t region = ownership[v] - first;
      const double away = std::hypot(grid_.cellOf(v).x - x[region] / cells[region],
                                     grid_.cellOf(v).y - y[region] / cells[region]);
      if (away >= nearest[region]) continue;
      nearest[region] = away;
      centres[region] = v;
    }
  }

  const Grid& grid_;
  const Units& units_;
  const std::vector<std::uint32_t>& clearance_;
  std::vector<Vertex> part_;
  std::vector<double> head_start_;
};

}  // namespace

Units corridorUnits(const Graph& graph) {
  constexpr std::uint32_t kCorridor = 2;
  Units units;
  units.unit_of.assign(graph.size(), kNoUnit);
  for (Vertex seed = 0; seed < graph.size(); ++seed) {
    if (units.unit_of[seed] != kNoUnit) continue;
    const auto number = static_cast<std::uint32_t>(units.members.size());
    std::vector<Vertex> members = {seed};
    units.unit_of[seed] = number;
    const bool corridor = graph.neighbours(seed).size() <= kCorridor;
    for (std::size_t head = 0; corridor && head < members.size(); ++head) {
      for (const Vertex u : graph.neighbours(members[head])) {
        if (units.unit_of[u] != kNoUnit || graph.neighbours(u).size() > kCorridor) continue;
        units.unit_of[u] = number;
        members.push_back(u);
      }
    }
    units.members.push_back(std::move(members));
  }
  return units;
}

Ownership balancedRegions(const Grid& grid, const Units& units, std::uint32_t count) {
  const Graph& graph = grid.graph();
  const Parts parts = partsOf(graph, Ownership(graph.size(), 0));
  std::vector<std::vector<Vertex>> cells(parts.size.size());
  for (Vertex v = 0; v < graph.size(); ++v) cells[parts.part_of[v]].push_back(v);
  const std::vector<std::uint32_t> clearance = clearances(graph);
  Ownership ownership(graph.size(), kNoRegion);
  std::vector<double> distance(graph.size(), 0);
  std::uint32_t first = 0;
  for (std::vector<Vertex>& part : cells) {
    const double fair = static_cast<double>(part.size()) * count / graph.size();
    const auto share = std::max(1U, static_cast<std::uint32_t>(std::lround(fair)));
    Growth(grid, units, clearance, std::move(part)).run(share, first, ownership, distance);
    first += share;
  }
  connectRegions(graph, ownership);
  return ownership;
}

}  // namespace split_mapf
