#include "split_mapf/core/grid.h"

#include <utility>

#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kMaxSide = 1U << 15;

void requireShape(std::uint32_t width, std::uint32_t height, std::size_t cells) {
  const std::string shape = std::to_string(width) + "x" + std::to_string(height);
  if (width == 0 || height == 0) throw InputError("a grid of " + shape + " has no cells");
  if (width > kMaxSide || height > kMaxSide) {
    throw InputError("a grid of " + shape + " is too large: a side may have at most " +
                     std::to_string(kMaxSide) + " cells");
  }
  if (cells != static_cast<std::size_t>(width) * height) {
    throw InputError("a grid of " + shape + " needs " +
                     std::to_string(static_cast<std::size_t>(width) * height) + " cells, got " +
                     std::to_string(cells));
  }
}

}  // namespace

std::string toString(Cell cell) {
  return "(" + std::to_string(cell.x) + "," + std::to_string(cell.y) + ")";
}

Grid::Grid(std::uint32_t width, std::uint32_t height, const std::vector<bool>& free)
    : width_(width), height_(height) {
  requireShape(width, height, free.size());
  vertices_.assign(free.size(), kNoVertex);
  for (std::uint32_t i = 0; i < free.size(); ++i) {
    if (!free[i]) continue;
    vertices_[i] = static_cast<Vertex>(cells_.size());
    cells_.push_back(i);
  }
  std::vector<std::pair<Vertex, Vertex>> edges;
  edges.reserve(cells_.size() * 2);
  for (Vertex v = 0; v < cells_.size(); ++v) {
    const std::uint32_t i = cells_[v];
    if (i % width + 1 < width && free[i + 1]) edges.emplace_back(v, vertices_[i + 1]);
    if (i / width + 1 < height && free[i + width]) edges.emplace_back(v, vertices_[i + width]);
  }
  graph_ = Graph(static_cast<std::uint32_t>(cells_.size()), edges);
}

}  // namespace split_mapf
