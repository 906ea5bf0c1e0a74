#include "split_mapf/core/grid.h"

#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <utility>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kMaxSide = 1U << 15;

void requireSides(std::uint32_t width, std::uint32_t height) {
  const std::string shape = std::to_string(width) + "x" + std::to_string(height);
  if (width == 0 || height == 0) throw InputError("a grid of " + shape + " has no cells");
  if (width > kMaxSide || height > kMaxSide) {
    throw InputError("a grid of " + shape + " is too large: a side may have at most " +
                     std::to_string(kMaxSide) + " cells");
  }
}

void requireShape(std::uint32_t width, std::uint32_t height, std::size_t cells) {
  requireSides(width, height);
  const std::string shape = std::to_string(width) + "x" + std::to_string(height);
  if (cells != static_cast<std::size_t>(width) * height) {
    throw InputError("a grid of " + shape + " needs " +
                     counted(static_cast<std::size_t>(width) * height, "cell") + ", got " +
                     std::to_string(cells));
  }
}

}  // namespace

std::string toString(Cell cell) {
  return "(" + std::to_string(cell.x) + "," + std::to_string(cell.y) + ")";
}

struct Grid::Deferred {
  std::once_flag once;
  Graph graph;
};

Grid::Grid(std::uint32_t width, std::uint32_t height, const std::vector<bool>& free,
           const Deadline& deadline)
    : width_(width), height_(height) {
  requireShape(width, height, free.size());
  numbering_ = CellNumbering(free, deadline);
  if (isHuge()) {
    deferred_ = std::make_shared<Deferred>();
    return;
  }
  SparsePoll poll(deadline);
  if (free.size() <= kHuge) vertices_.assign(free.size(), kNoVertex);
  cells_.reserve(size());
  for (Vertex v = 0; v < size(); ++v) {
    poll();
    const std::size_t i = numbering_.cellOf(v);
    if (!vertices_.empty()) vertices_[i] = v;
    cells_.push_back(static_cast<std::uint32_t>(i));
  }
  graph_ = buildGraph(deadline);
}

Graph Grid::buildGraph(const Deadline& deadline) const {
  SparsePoll poll(deadline);
  std::vector<std::uint32_t> offsets = {0};
  std::vector<Vertex> targets;
  offsets.reserve(std::size_t{size()} + 1);
  targets.reserve(std::size_t{size()} * 4);
  for (Vertex v = 0; v < size(); ++v) {
    poll();
    const Cell c = cellOf(v);
    for (const Cell next :
         {Cell{c.x, c.y - 1}, Cell{c.x - 1, c.y}, Cell{c.x + 1, c.y}, Cell{c.x, c.y + 1}}) {
      const Vertex u = vertexAt(next);
      if (u != kNoVertex) targets.push_back(u);
    }
    offsets.push_back(static_cast<std::uint32_t>(targets.size()));
  }
  return Graph(std::move(offsets), std::move(targets), deadline);
}

const Graph& Grid::deferredGraph(const Deadline& deadline) const {
  std::call_once(deferred_->once, [&] { deferred_->graph = buildGraph(deadline); });
  return deferred_->graph;
}

Grid::Grid(std::uint32_t width, std::uint32_t height, std::vector<std::uint32_t> cells,
           const std::vector<std::pair<Vertex, Vertex>>& edges)
    : width_(width), height_(height), cells_(std::move(cells)), unit_moves_(false) {
  requireSides(width, height);
  std::vector<bool> marked(std::size_t{width} * height, false);
  for (Vertex v = 0; v < cells_.size(); ++v) {
    if (cells_[v] >= marked.size() || (v > 0 && cells_[v] <= cells_[v - 1])) {
      throw InputError("vertex " + std::to_string(v) + " of a planning graph on a map of " +
                       std::to_string(width) + "x" + std::to_string(height) + " cells is in cell " +
                       std::to_string(cells_[v]) + ", expected ascending cells of the map");
    }
    marked[cells_[v]] = true;
  }
  numbering_ = CellNumbering(marked);
  graph_ = Graph(size(), edges);
  for (const auto& [a, b] : edges) {
    longest_move_ = std::max(longest_move_, rowsAndColumns(cellOf(a), cellOf(b)));
  }
}

bool Grid::isStep(Cell from, Cell to) const {
  if (unit_moves_) {
    return std::abs(std::int64_t{from.x} - to.x) + std::abs(std::int64_t{from.y} - to.y) <= 1;
  }
  if (from == to) return true;
  const Vertex a = vertexAt(from);
  const Vertex b = vertexAt(to);
  return a != kNoVertex && b != kNoVertex && graph_.adjacent(a, b);
}

}  // namespace split_mapf
