#include "split_mapf/core/distance_table.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/detour_search.h"
#include "core/guided_search.h"

namespace split_mapf {
namespace {

constexpr std::size_t kPollEvery = std::size_t{1} << 16U;
// Vertices for which a thread keeps the queue of its last search.
constexpr std::size_t kKeptQueue = std::size_t{1} << 20U;

/// A thread's queue, given back at the end of a search if it is large.
class LentQueue {
 public:
  explicit LentQueue(std::size_t size) : queue_(kept()) {
    if (queue_.size() < size) queue_.resize(size);
  }
  ~LentQueue() {
    if (queue_.size() > kKeptQueue) std::vector<Vertex>().swap(queue_);
  }
  LentQueue(const LentQueue&) = delete;
  LentQueue& operator=(const LentQueue&) = delete;
  std::vector<Vertex>& get() { return queue_; }

 private:
  // A fresh queue for each of a thousand tables costs more than the search.
  static std::vector<Vertex>& kept() {
    thread_local std::vector<Vertex> queue;
    return queue;
  }
  std::vector<Vertex>& queue_;
};

}  // namespace

DistanceTable::DistanceTable(const Graph& graph, Vertex goal, DistanceExtent extent,
                             const Deadline& deadline)
    : goal_(goal) {
  if (extent == DistanceExtent::kAll) {
    narrow_.assign(graph.size(), kNarrowUnknown);
    narrow_[goal] = 0;
    searchAll(graph, deadline);
    return;
  }
  startOnDemand(graph);
  queue_.push_back(goal);
}

DistanceTable::~DistanceTable() = default;

void DistanceTable::startOnDemand(const Graph& graph) {
  graph_ = &graph;
  narrow_.assign(kPageSize, kNarrowUnknown);
  page_of_.assign((graph.size() >> kPageBits) + 1, 0);
  settle(goal_, 0);
}

void DistanceTable::searchAll(const Graph& graph, const Deadline& deadline) {
  LentQueue lent(std::size_t{graph.size()} + 1);
  std::vector<Vertex>& queue = lent.get();
  std::size_t head = 0;
  std::size_t tail = 0;
  queue[tail++] = goal_;
  if (graph.rowsOfFour() != nullptr) {
    searchByFours(graph.rowsOfFour(), queue.data(), head, tail, deadline);
  }
  SparsePoll poll(deadline);
  for (; head < tail; ++head) {
    poll();
    const Vertex v = queue[head];
    const auto next = static_cast<std::uint16_t>(narrow_[v] + 1);
    for (const Vertex u : graph.neighbours(v)) {
      if (narrow_[u] != kNarrowUnknown) continue;
      if (next == kNarrowUnknown) return searchWide(graph, queue, head, tail, deadline);
      narrow_[u] = next;
      queue[tail++] = u;
    }
  }
}

void DistanceTable::searchByFours(const Vertex* rows, Vertex* queue, std::size_t& head,
                                  std::size_t& tail, const Deadline& deadline) {
  std::uint16_t* const distance = narrow_.data();
  std::size_t end = tail;
  std::size_t from = head;
  // Whether a neighbour is new cannot be predicted: all are written behind the queue's end, which
  // moves on past the new ones. The four differ, or are the vertex itself, which is known.
  for (; from < end; ++from) {
    if (from % kPollEvery == kPollEvery - 1) deadline.require();
    const Vertex v = queue[from];
    const auto next = static_cast<std::uint16_t>(distance[v] + 1);
    if (next == kNarrowUnknown) break;
    const Vertex* const row = rows + std::size_t{v} * 4;
    std::array<Vertex, 4> u{};
    std::array<std::uint16_t, 4> known{};
    for (std::size_t i = 0; i < 4; ++i) u[i] = row[i];
    for (std::size_t i = 0; i < 4; ++i) known[i] = distance[u[i]];
    for (std::size_t i = 0; i < 4; ++i) {
      queue[end] = u[i];
      end += known[i] == kNarrowUnknown ? 1 : 0;
    }
    for (std::size_t i = 0; i < 4; ++i) distance[u[i]] = std::min(known[i], next);
  }
  head = from;
  tail = end;
}

void DistanceTable::searchWide(const Graph& graph, std::vector<Vertex>& queue, std::size_t head,
                               std::size_t tail, const Deadline& deadline) {
  widen();
  SparsePoll poll(deadline);
  for (; head < tail; ++head) {
    poll();
    for (const Vertex u : graph.neighbours(queue[head])) {
      if (wide_[u] != kUnreachable) continue;
      wide_[u] = wide_[queue[head]] + 1;
      queue[tail++] = u;
    }
  }
}

std::uint32_t DistanceTable::search(Vertex v) const {
  if (detours_) return searchDetours(v);
  if (guided_) return searchGuided(v);
  while (head_ < queue_.size()) {
    const Vertex from = queue_[head_++];
    const std::uint32_t next = (wide_.empty() ? narrow_[placeOf(from)] : wide_[from]) + 1U;
    bool met = false;
    for (const Vertex u : graph_->neighbours(from)) {
      if (isKnown(u)) continue;
      settle(u, next);
      queue_.push_back(u);
      met = met || u == v;
    }
    if (met) return next;
  }
  return kUnreachable;
}

void DistanceTable::settle(Vertex v, std::uint32_t distance) const {
  if (wide_.empty() && distance == kNarrowUnknown) widen();
  if (!wide_.empty()) {
    wide_[v] = distance;
    return;
  }
  takePage(v);
  narrow_[placeOf(v)] = static_cast<std::uint16_t>(distance);
}

void DistanceTable::takePage(Vertex v) const {
  std::uint32_t& page = page_of_[v >> kPageBits];
  if (page != 0) return;
  page = static_cast<std::uint32_t>(narrow_.size() / kPageSize);
  narrow_.resize(narrow_.size() + kPageSize, kNarrowUnknown);
}

void DistanceTable::widen() const {
  const std::size_t vertices = graph_ == nullptr ? narrow_.size() : graph_->size();
  std::vector<std::uint32_t> wide(vertices);
  for (Vertex v = 0; v < vertices; ++v) {
    const std::uint16_t d = narrow_[graph_ == nullptr ? v : placeOf(v)];
    wide[v] = d == kNarrowUnknown ? kUnreachable : d;
  }
  wide_ = std::move(wide);
  narrow_.clear();
  narrow_.shrink_to_fit();
}

std::size_t DistanceTable::bytes() const {
  std::size_t bytes = sizeof *this + narrow_.capacity() * sizeof narrow_[0] +
                      page_of_.capacity() * sizeof page_of_[0] +
                      wide_.capacity() * sizeof wide_[0] + queue_.capacity() * sizeof queue_[0];
  if (guided_) bytes += bytesOfGuide();
  if (detours_) bytes += bytesOfDetours();
  return bytes;
}

}  // namespace split_mapf
