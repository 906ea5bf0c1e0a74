#include "split_mapf/core/grid.h"

#include <mutex>
#include <utility>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

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

}  // namespace split_mapf
