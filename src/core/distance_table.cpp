#include "split_mapf/core/distance_table.h"

#include <utility>

namespace split_mapf {
namespace {

/// Fills `distances` level by level. Returns false, with the table unfinished, when a level would
/// reach the value reserved for "unreachable".
template <typename Entry>
bool searchBreadthFirst(const Graph& graph, Vertex goal, Entry unreachable,
                        std::vector<Entry>& distances) {
  distances.assign(graph.size(), unreachable);
  std::vector<Vertex> queue(graph.size());
  std::size_t head = 0;
  std::size_t tail = 0;
  distances[goal] = 0;
  queue[tail++] = goal;
  while (head < tail) {
    const Vertex v = queue[head++];
    const auto next = static_cast<Entry>(distances[v] + 1);
    for (const Vertex u : graph.neighbours(v)) {
      if (distances[u] != unreachable) continue;
      if (next == unreachable) return false;
      distances[u] = next;
      queue[tail++] = u;
    }
  }
  return true;
}

}  // namespace

DistanceTable::DistanceTable(const Graph& graph, Vertex goal) : goal_(goal) {
  if (searchBreadthFirst(graph, goal, kNarrowUnreachable, narrow_)) return;
  narrow_.clear();
  narrow_.shrink_to_fit();
  searchBreadthFirst(graph, goal, kUnreachable, wide_);
}

DistanceTables::DistanceTables(const Graph& graph, const std::vector<Vertex>& goals)
    : graph_(&graph), goals_(goals), slots_(goals.size()) {}

const DistanceTable& DistanceTables::operator[](std::uint32_t i) const {
  Slot& slot = slots_[i];
  std::call_once(slot.once, [&] {
    if (!slot.table) slot.table = std::make_shared<const DistanceTable>(*graph_, goals_[i]);
  });
  return *slot.table;
}

void DistanceTables::adopt(std::uint32_t i, std::shared_ptr<const DistanceTable> table) {
  Slot& slot = slots_[i];
  std::call_once(slot.once, [&] { slot.table = std::move(table); });
}

std::shared_ptr<const DistanceTable> DistanceTables::share(std::uint32_t i) const {
  (*this)[i];
  return slots_[i].table;
}

}  // namespace split_mapf
