#include "pipeline/rolling/slopes.h"

#include <algorithm>
#include <utility>

namespace split_mapf::rolling {
namespace {

// Levels are distances without their higher bits: neighbours differ by one at most. A byte each
// leaves them in the nearest cache.
constexpr std::uint8_t kUnknown = 0xffU;
constexpr std::uint32_t kLevelMask = 0x7fU;

}  // namespace

std::uint32_t Slope::distance(const MoveGraph& graph, Vertex from, std::uint32_t most) const {
  std::uint32_t steps = 0;
  for (Vertex v = from; steps < most; ++steps) {
    const auto nearer = static_cast<std::uint32_t>(bytes_[v] & 0xfU);
    if (nearer == 0) break;  // only the goal has no way to come nearer
    v = graph[v].next[static_cast<std::size_t>(__builtin_ctz(nearer))];
  }
  return steps;
}

bool SlopeCache::close(const std::vector<bool>& closed) {
  if (closed == closed_) return false;
  closed_ = closed;
  any_closed_ = std::find(closed.begin(), closed.end(), true) != closed.end();
  entries_.clear();
  return true;
}

std::shared_ptr<const Slope> SlopeCache::find(Vertex goal) {
  Entry& entry = entries_[goal];
  entry.used = ++uses_;
  if (!entry.slope) {
    entry.slope = std::make_shared<const Slope>(search(goal));
    std::shared_ptr<const Slope> slope = entry.slope;
    if (bytes() > most_bytes_) makeRoom();
    return slope;
  }
  return entry.slope;
}

void SlopeCache::makeRoom() {
  // An eighth at once, so that looking through all of them pays.
  std::vector<std::pair<std::uint64_t, Vertex>> idle;
  for (const auto& [goal, entry] : entries_) {
    if (entry.slope.use_count() == 1) idle.emplace_back(entry.used, goal);
  }
  std::sort(idle.begin(), idle.end());
  const std::size_t aim = most_bytes_ - most_bytes_ / 8;
  for (const auto& [used, goal] : idle) {
    if (bytes() <= aim) break;
    entries_.erase(goal);
  }
}

std::vector<std::uint8_t> SlopeCache::search(Vertex goal) {
  findLevels(goal);
  std::vector<std::uint8_t> slope(graph_.size());
  for (Vertex v = 0; v < graph_.size(); ++v) {
    const MoveGraph::Node& node = graph_[v];
    const std::uint32_t own = levels_[v];
    if (own == kUnknown) {
      slope[v] = Slope::kCutOff;
      continue;
    }
    std::uint32_t nearer = 0;
    std::uint32_t same = 0;
    for (std::uint32_t slot = 0; slot < kSlots; ++slot) {
      const Vertex u = node.next[slot];
      const std::uint32_t farther = (levels_[u] - own) & kLevelMask;
      const bool known = levels_[u] != kUnknown;  // else only a closed vertex is beside it
      nearer |= (known && farther == kLevelMask ? 1U : 0U) << slot;
      same |= (known && farther == 0 && u != v ? 1U : 0U) << slot;
    }
    slope[v] = static_cast<std::uint8_t>(nearer | same << kSlots);
  }
  if (any_closed_) leadAround(goal, slope);
  return slope;
}

void SlopeCache::findLevels(Vertex goal) {
  levels_.assign(graph_.size(), kUnknown);
  queue_.resize(std::size_t{graph_.size()} + kSlots);
  std::size_t tail = 0;
  queue_[tail++] = goal;
  levels_[goal] = 0;
  for (std::size_t head = 0; head < tail; ++head) {
    const Vertex v = queue_[head];
    if (closed_[v] && v != goal) continue;
    const auto next = static_cast<std::uint8_t>((levels_[v] + 1U) & kLevelMask);
    // Whether a neighbour is new cannot be predicted, so all are written behind the queue's end.
    for (const Vertex u : graph_[v].next) {
      const bool is_new = levels_[u] == kUnknown;
      queue_[tail] = u;
      tail += is_new ? 1 : 0;
      levels_[u] = is_new ? next : levels_[u];
    }
  }
}

void SlopeCache::leadAround(Vertex goal, std::vector<std::uint8_t>& slope) const {
  for (Vertex u = 0; u < graph_.size(); ++u) {
    if (!closed_[u] || u == goal) continue;
    const MoveGraph::Node& node = graph_[u];
    for (Slot slot = 0; slot < node.degree; ++slot) {
      const Vertex v = node.next[slot];
      if (slope[v] == Slope::kCutOff) continue;
      slope[v] &= static_cast<std::uint8_t>(~(0x11U << node.back[slot]));
    }
  }
}

}  // namespace split_mapf::rolling
