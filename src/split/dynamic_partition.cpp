#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "split/balanced_regions.h"
#include "split/narrow_borders.h"
#include "split/region_repair.h"
#include "split_mapf/split/partition.h"

namespace split_mapf {
namespace {

// How deep a buffer may reach into a region, of the side of a square as large as the region.
constexpr double kDeepestShare = 0.125;

/// Two neighbouring regions, the lower number first.
using Border = std::pair<std::uint32_t, std::uint32_t>;

Border borderOf(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// How many robots' shortest paths cross each border.
std::map<Border, std::uint32_t> countCrossings(const Instance& instance, const Ownership& base) {
  std::map<Border, std::uint32_t> crossings;
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    const HeldDistances to_goal = instance.distances(robot);
    Vertex v = instance.start(robot);
    for (std::uint32_t left = to_goal(v); left > 0; --left) {
      const VertexRange neighbours = instance.graph().neighbours(v);
      const Vertex u = *std::find_if(neighbours.begin(), neighbours.end(),
                                     [&](Vertex next) { return to_goal(next) + 1 == left; });
      if (base[u] != base[v]) ++crossings[borderOf(base[u], base[v])];
      v = u;
    }
  }
  return crossings;
}

/// Grows buffer blocks from the borders of a partition into both sides, level by level.
class Buffers {
 public:
  Buffers(const Grid& grid, const Units& units, const Ownership& base, BufferSize size)
      : grid_(grid),
        units_(units),
        base_(base),
        size_(size),
        border_of_(grid.size(), nullptr),
        colour_(grid.size(), 0) {}

  void grow(const std::map<Border, std::uint32_t>& crossings, std::uint32_t deepest) {
    plant(crossings);
    for (std::uint32_t depth = 1; depth < deepest && !front_.empty(); ++depth) {
      std::vector<Vertex> before;
      before.swap(front_);
      for (const Vertex v : before) {
        Exchange& exchange = *border_of_[v];
        if (2 * depth >= size_.across && exchange.cells >= exchange.wanted) continue;
        for (const Vertex u : grid_.graph().neighbours(v)) take(u, exchange, colour_[v]);
      }
    }
  }

  /// Who owns the cells in even (0) or odd (1) phases.
  Ownership ownership(std::uint32_t phase) const {
    Ownership result = base_;
    for (Vertex v = 0; v < result.size(); ++v) {
      if (border_of_[v] == nullptr) continue;
      const Border& border = border_of_[v]->border;
      result[v] = (colour_[v] + phase) % 2 == 0 ? border.first : border.second;
    }
    return result;
  }

 private:
  /// The buffer of one border.
  struct Exchange {
    Border border;
    std::uint32_t cells = 0;
    std::uint32_t wanted = 0;
  };

  /// Blocks begin at the edges that cross a border, and alternate along it.
  void plant(const std::map<Border, std::uint32_t>& crossings) {
    for (Vertex v = 0; v < grid_.size(); ++v) {
      for (const Vertex u : grid_.graph().neighbours(v)) {
        if (base_[v] >= base_[u]) continue;
        const Border border = borderOf(base_[v], base_[u]);
        const auto crossed = crossings.find(border);
        Exchange& exchange = exchanges_[border];
        exchange.border = border;
        // Half full at most, and half of it for each direction.
        if (crossed != crossings.end()) exchange.wanted = 2 * crossed->second;
        const Cell cell = grid_.cellOf(v);
        const auto along = static_cast<std::int32_t>(size_.along * grid_.longestMove());
        const auto colour = static_cast<std::uint8_t>((cell.x / along + cell.y / along) % 2);
        take(v, exchange, colour);
        take(u, exchange, colour);
      }
    }
  }

  void take(Vertex v, Exchange& exchange, std::uint8_t colour) {
    for (const Vertex member : units_.members[units_.unit_of[v]]) {
      const bool inside =
          base_[member] == exchange.border.first || base_[member] == exchange.border.second;
      if (!inside || border_of_[member] != nullptr) continue;
      border_of_[member] = &exchange;
      colour_[member] = colour;
      ++exchange.cells;
      front_.push_back(member);
    }
  }

  const Grid& grid_;
  const Units& units_;
  const Ownership& base_;
  BufferSize size_;
  std::map<Border, Exchange> exchanges_;
  std::vector<Exchange*> border_of_;
  std::vector<std::uint8_t> colour_;
  std::vector<Vertex> front_;
};

}  // namespace

Partition partitionDynamic(const Instance& instance, std::uint32_t regions, BufferSize buffer) {
  const Units units = corridorUnits(instance.graph());
  Ownership base = balancedRegions(instance.grid(), units, regions);
  narrowBorders(instance.graph(), units, base);
  Buffers buffers(instance.grid(), units, base, buffer);
  // Never so deep that little is left of a region between its borders.
  const double side = std::sqrt(static_cast<double>(instance.graph().size()) / regions);
  const std::uint32_t deepest =
      std::max({1U, buffer.across / 2, static_cast<std::uint32_t>(side * kDeepestShare)});
  buffers.grow(countCrossings(instance, base), deepest + 1);
  Partition partition;
  partition.kind = "dynamic";
  for (std::uint32_t phase = 0; phase < 2; ++phase) {
    partition.ownerships[phase] = buffers.ownership(phase);
    connectRegions(instance.graph(), partition.ownerships[phase]);
  }
  return partition;
}

}  // namespace split_mapf
