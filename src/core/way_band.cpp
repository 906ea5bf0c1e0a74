#include "split_mapf/core/way_band.h"

#include <utility>

#include "split_mapf/core/shortest_way.h"

namespace split_mapf {
namespace {

/// Marks the cells of the ways and, step by step, all free ones around.
std::vector<bool> markBand(const Grid& grid, const std::vector<Path>& ways, std::uint32_t margin,
                           SparsePoll& poll) {
  std::vector<bool> marked(std::size_t{grid.width()} * grid.height());
  std::vector<Cell> edge;
  const auto mark = [&](Cell c) {
    poll();
    if (!grid.isFree(c)) return;
    auto bit = marked[static_cast<std::size_t>(c.y) * grid.width() + static_cast<std::size_t>(c.x)];
    if (bit) return;
    bit = true;
    edge.push_back(c);
  };
  for (const Path& way : ways) {
    for (const Vertex v : way) mark(grid.cellOf(v));
  }
  for (std::uint32_t step = 0; step < margin && !edge.empty(); ++step) {
    const std::vector<Cell> last = std::exchange(edge, {});
    for (const Cell c : last) {
      for (const Cell next :
           {Cell{c.x, c.y - 1}, Cell{c.x - 1, c.y}, Cell{c.x + 1, c.y}, Cell{c.x, c.y + 1}}) {
        mark(next);
      }
    }
  }
  return marked;
}

}  // namespace

WayBand::WayBand(const Instance& instance, const std::vector<Path>& ways, std::uint32_t margin,
                 const Deadline& deadline)
    : map_(instance.sharedGrid()) {
  SparsePoll poll(deadline);
  const std::vector<bool> marked = markBand(*map_, ways, margin, poll);
  const auto grid = std::make_shared<const Grid>(map_->width(), map_->height(), marked, deadline);
  std::vector<Cell> starts;
  std::vector<Cell> goals;
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    starts.push_back(map_->cellOf(instance.start(robot)));
    goals.push_back(map_->cellOf(instance.goal(robot)));
  }
  instance_ = std::make_shared<const Instance>(grid, starts, goals);
}

bool WayBand::isNearlyAll() const { return instance_->grid().size() > map_->size() / 2; }

Vertex WayBand::onMap(Vertex v) const { return map_->vertexAt(instance_->grid().cellOf(v)); }

std::vector<Path> findShortestWays(const Instance& instance, const Deadline& deadline) {
  std::vector<Path> ways;
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    // A way of some thousand steps takes the memory of a whole map and asks for time hardly once.
    deadline.require();
    ways.push_back(
        findShortestWay(instance.grid(), instance.start(robot), instance.goal(robot), deadline));
    if (ways.back().empty()) return {};
  }
  return ways;
}

}  // namespace split_mapf
