#include "pipeline/rolling/slopes.h"

#include <algorithm>
#include <utility>

namespace split_mapf::rolling {
namespace {

constexpr std::uint32_t kUnknown = 0xffffffffU;

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
  ++searches_;
  distances_.assign(graph_.size(), kUnknown);
  queue_.resize(std::size_t{graph_.size()} + 4);
  std::size_t tail = 0;
  queue_[tail++] = goal;
  distances_[goal] = 0;
  for (std::size_t head = 0; head < tail; ++head) {
    const Vertex v = queue_[head];
    if (closed_[v] && v != goal) continue;
    const std::uint32_t next = distances_[v] + 1;
    for (const Vertex u : graph_[v].next) {
      queue_[tail] = u;
      tail += distances_[u] == kUnknown ? 1 : 0;
      distances_[u] = std::min(distances_[u], next);
    }
  }
  std::vector<std::uint8_t> slope(graph_.size());
  for (Vertex v = 0; v < graph_.size(); ++v) {
    const MoveGraph::Node& node = graph_[v];
    const std::uint32_t own = distances_[v];
    std::uint32_t bits = own == kUnknown ? Slope::kCutOff : 0;
    for (std::uint32_t slot = 0; own != kUnknown && slot < kSlots; ++slot) {
      const Vertex u = node.next[slot];
      if (u == v || (closed_[u] && u != goal)) continue;
      bits |= distances_[u] < own ? 1U << slot : 0U;
      bits |= distances_[u] == own ? 16U << slot : 0U;
    }
    slope[v] = static_cast<std::uint8_t>(bits);
  }
  return slope;
}

}  // namespace split_mapf::rolling
