#include "roadmap/lattice.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace split_mapf::roadmap {
namespace {

constexpr std::int32_t kBlocked = std::numeric_limits<std::int32_t>::max();

}  // namespace

std::uint32_t Pieces::of(std::uint32_t cell) const {
  while (parents_[cell] >= 0) cell = static_cast<std::uint32_t>(parents_[cell]);
  return cell;
}

// Both are called for each cell of the map, and only here.
inline std::uint32_t Pieces::find(std::uint32_t cell) {
  while (parents_[cell] >= 0) {
    const auto parent = static_cast<std::uint32_t>(parents_[cell]);
    if (parents_[parent] >= 0) parents_[cell] = parents_[parent];
    cell = parent;
  }
  return cell;
}

inline std::uint32_t Pieces::unite(std::uint32_t a, std::uint32_t b) {
  if (a == b) return a;
  // The larger keeps its name; of equals the one that comes first.
  if (parents_[a] > parents_[b] || (parents_[a] == parents_[b] && b < a)) std::swap(a, b);
  parents_[a] += parents_[b];
  parents_[b] = static_cast<std::int32_t>(a);
  return a;
}

Pieces::Pieces(const ClearSpace& space, std::uint32_t step, const Deadline& deadline) {
  const std::uint32_t width = space.raster().width;
  parents_.assign(space.cells(), kBlocked);
  std::vector<std::uint32_t> below(width, 0);  // column -> clear cells in a row above, own included
  std::uint32_t cell = 0;
  for (std::uint32_t y = 0; y < space.raster().height; ++y) {
    if (y % 64 == 0 && deadline.expired()) {
      parents_.clear();
      return;
    }
    std::uint32_t run = 0;
    for (std::uint32_t x = 0; x < width; ++x, ++cell) {
      if (!space.isClear(cell)) {
        run = below[x] = 0;
        continue;
      }
      parents_[cell] = -1;
      std::uint32_t name = cell;
      if (++run > step) name = unite(find(cell - step), name);
      if (++below[x] > step) unite(find(cell - step * width), name);
    }
  }
}

std::vector<Offset> bestOffsets(const ClearSpace& space, std::uint32_t step, std::uint32_t count,
                                const Deadline& deadline) {
  const Pieces pieces(space, step, deadline);
  if (pieces.isEmpty()) return {};
  std::vector<Offset> all(std::size_t{step} * step);
  std::uint32_t cell = 0;
  for (std::uint32_t y = 0; y < space.raster().height; ++y) {
    Offset* row = all.data() + std::size_t{y % step} * step;
    std::uint32_t column = 0;
    for (std::uint32_t x = 0; x < space.raster().width; ++x, ++cell) {
      if (pieces.isName(cell)) {
        row[column].weight += std::uint64_t{pieces.size(cell)} * pieces.size(cell);
      }
      if (++column == step) column = 0;
    }
  }
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    all[i].x = i % step;
    all[i].y = i / step;
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Offset& a, const Offset& b) { return a.weight > b.weight; });
  const auto apart = [step](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t d = a > b ? a - b : b - a;
    return std::min(d, step - d);
  };
  std::vector<Offset> best;
  for (const Offset& offset : all) {
    if (best.size() == count || offset.weight == 0) break;
    const bool known = std::any_of(best.begin(), best.end(), [&](const Offset& other) {
      return apart(other.x, offset.x) <= step / 4 && apart(other.y, offset.y) <= step / 4;
    });
    if (!known) best.push_back(offset);
  }
  return best;
}

CellGraph latticeAt(const ClearSpace& space, std::uint32_t step, const Offset& offset) {
  const std::uint32_t width = space.raster().width;
  const std::uint32_t height = space.raster().height;
  CellGraph graph;
  std::vector<std::uint32_t> above((width - 1 - std::min(offset.x, width - 1)) / step + 1);
  constexpr std::uint32_t kNone = 0xffffffffU;
  std::fill(above.begin(), above.end(), kNone);
  for (std::uint32_t y = offset.y; y < height; y += step) {
    std::uint32_t left = kNone;
    std::uint32_t column = 0;
    for (std::uint32_t x = offset.x; x < width; x += step, ++column) {
      const Cell at{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
      if (!space.isClear(at)) {
        left = above[column] = kNone;
        continue;
      }
      const auto vertex = static_cast<std::uint32_t>(graph.cells.size());
      const auto back = static_cast<std::int32_t>(step);
      graph.cells.push_back(y * width + x);
      if (left != kNone && space.isClearWay({at.x - back, at.y}, at)) {
        graph.edges.emplace_back(left, vertex);
      }
      if (above[column] != kNone && space.isClearWay({at.x, at.y - back}, at)) {
        graph.edges.emplace_back(above[column], vertex);
      }
      left = above[column] = vertex;
    }
  }
  std::sort(graph.edges.begin(), graph.edges.end());
  return graph;
}

}  // namespace split_mapf::roadmap
