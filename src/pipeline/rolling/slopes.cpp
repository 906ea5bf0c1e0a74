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
    entry.slope = make(goal, searches_.front());
    std::shared_ptr<const Slope> slope = entry.slope;
    if (bytes() > most_bytes_) makeRoom();
    return slope;
  }
  return entry.slope;
}

std::shared_ptr<const Slope> SlopeCache::known(Vertex goal) {
  const auto entry = entries_.find(goal);
  if (entry == entries_.end()) return nullptr;
  entry->second.used = ++uses_;
  return entry->second.slope;
}

void SlopeCache::findAll(const std::vector<Vertex>& goals, ThreadTeam& team,
                         std::vector<std::shared_ptr<const Slope>>& found) {
  std::vector<Vertex> missing;
  for (const Vertex goal : goals) {
    if (!has(goal)) missing.push_back(goal);
  }
  std::sort(missing.begin(), missing.end());
  missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
  if (searches_.size() < team.threads()) searches_.resize(team.threads());
  std::vector<std::shared_ptr<const Slope>> made(missing.size());
  team.forEach(static_cast<std::uint32_t>(missing.size()),
               [&](std::uint32_t i, std::uint32_t member) {
                 made[i] = make(missing[i], searches_[member]);
               });
  for (std::size_t i = 0; i < missing.size(); ++i) entries_[missing[i]].slope = made[i];
  for (const Vertex goal : goals) found.push_back(find(goal));
  if (bytes() > most_bytes_) makeRoom();
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

std::shared_ptr<const Slope> SlopeCache::make(Vertex goal, Search& search) const {
  findLevels(goal, search);
  const std::vector<std::uint8_t>& levels = search.levels;
  std::vector<std::uint8_t> slope(graph_.size());
  for (Vertex v = 0; v < graph_.size(); ++v) {
    const MoveGraph::Node& node = graph_[v];
    const std::uint32_t own = levels[v];
    if (own == kUnknown) {
      slope[v] = Slope::kCutOff;
      continue;
    }
    std::uint32_t nearer = 0;
    std::uint32_t same = 0;
    for (std::uint32_t slot = 0; slot < kSlots; ++slot) {
      const Vertex u = node.next[slot];
      const std::uint32_t farther = (levels[u] - own) & kLevelMask;
      const bool known = levels[u] != kUnknown;  // else only a closed vertex is beside it
      nearer |= (known && farther == kLevelMask ? 1U : 0U) << slot;
      same |= (known && farther == 0 && u != v ? 1U : 0U) << slot;
    }
    slope[v] = static_cast<std::uint8_t>(nearer | same << kSlots);
  }
  if (any_closed_) leadAround(goal, slope);
  return std::make_shared<const Slope>(std::move(slope));
}

void SlopeCache::findLevels(Vertex goal, Search& search) const {
  std::vector<std::uint8_t>& levels = search.levels;
  std::vector<Vertex>& queue = search.queue;
  levels.assign(graph_.size(), kUnknown);
  queue.resize(std::size_t{graph_.size()} + kSlots);
  std::size_t tail = 0;
  queue[tail++] = goal;
  levels[goal] = 0;
  for (std::size_t head = 0; head < tail; ++head) {
    const Vertex v = queue[head];
    if (closed_[v] && v != goal) continue;
    const auto next = static_cast<std::uint8_t>((levels[v] + 1U) & kLevelMask);
    // Whether a neighbour is new cannot be predicted, so all are written behind the queue's end.
    for (const Vertex u : graph_[v].next) {
      const bool is_new = levels[u] == kUnknown;
      queue[tail] = u;
      tail += is_new ? 1 : 0;
      levels[u] = is_new ? next : levels[u];
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
