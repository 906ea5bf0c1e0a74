// A fixed piece of work of the kind that planning is: breadth-first and best-first searches over a
// grid, a hash table, memory out of order. What this takes is the unit of scripts/benchmark, so
// that figures of different machines and days compare. It uses nothing of the library, and must
// never change: every recorded figure would change with it.

#include <cstdint>
#include <cstdio>
#include <functional>
#include <queue>
#include <unordered_map>
#include <utility>
#include <vector>

namespace {

constexpr std::uint32_t kSide = 600;
constexpr std::uint32_t kCells = kSide * kSide;
constexpr std::uint32_t kUnreached = 0xFFFFFFFF;

/// A walled grid, one cell in five blocked, the same everywhere.
std::vector<char> makeBlocked() {
  std::vector<char> blocked(kCells, 0);
  std::uint64_t state = 88172645463325252ULL;
  for (std::uint32_t cell = 0; cell < kCells; ++cell) {
    state ^= state << 13U;
    state ^= state >> 7U;
    state ^= state << 17U;
    const std::uint32_t x = cell % kSide;
    const std::uint32_t y = cell / kSide;
    const bool wall = x == 0 || y == 0 || x == kSide - 1 || y == kSide - 1;
    blocked[cell] = static_cast<char>(wall || state % 5 == 0);
  }
  return blocked;
}

std::uint32_t firstFree(const std::vector<char>& blocked, std::uint32_t from) {
  while (blocked[from] != 0) ++from;
  return from;
}

template <class Visit>
void visitNeighbours(std::uint32_t cell, Visit visit) {
  for (const std::uint32_t next : {cell - kSide, cell - 1, cell + 1, cell + kSide}) visit(next);
}

std::vector<std::uint32_t> breadthFirst(const std::vector<char>& blocked, std::uint32_t root) {
  std::vector<std::uint32_t> distance(kCells, kUnreached);
  std::vector<std::uint32_t> queue{root};
  distance[root] = 0;
  for (std::size_t k = 0; k < queue.size(); ++k) {
    visitNeighbours(queue[k], [&](std::uint32_t next) {
      if (blocked[next] != 0 || distance[next] != kUnreached) return;
      distance[next] = distance[queue[k]] + 1;
      queue.push_back(next);
    });
  }
  return distance;
}

/// Dijkstra's search where steps cost 1 to 4; returns how many cells it has closed.
std::uint64_t bestFirst(const std::vector<char>& blocked, std::uint32_t root) {
  using Entry = std::pair<std::uint32_t, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::unordered_map<std::uint32_t, std::uint32_t> cost;
  std::uint64_t closed = 0;
  open.push({0, root});
  cost[root] = 0;
  while (!open.empty() && closed < kCells / 4) {
    const auto [so_far, cell] = open.top();
    open.pop();
    if (so_far > cost[cell]) continue;
    ++closed;
    visitNeighbours(cell, [&, so_far = so_far](std::uint32_t next) {
      if (blocked[next] != 0) return;
      const std::uint32_t reached = so_far + 1 + next % 4;
      const auto [entry, is_new] = cost.try_emplace(next, reached);
      if (!is_new && entry->second <= reached) return;
      entry->second = reached;
      open.push({reached, next});
    });
  }
  return closed;
}

}  // namespace

int main() {
  const std::vector<char> blocked = makeBlocked();
  std::uint64_t sum = 0;
  for (std::uint32_t turn = 1; turn <= 4; ++turn) {
    const std::uint32_t root = firstFree(blocked, kSide * (100 * turn) + 10 * turn);
    const std::vector<std::uint32_t> distance = breadthFirst(blocked, root);
    for (std::uint32_t k = 0; k < kCells; ++k) {
      const std::uint32_t cell = static_cast<std::uint32_t>(std::uint64_t{k} * 7919 % kCells);
      if (distance[cell] != kUnreached) sum += distance[cell];
    }
    sum += bestFirst(blocked, root);
  }
  // Printed so that no compiler leaves the work out.
  std::printf("%llu\n", static_cast<unsigned long long>(sum));
  return 0;
}
