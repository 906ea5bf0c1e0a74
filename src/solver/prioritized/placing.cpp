#include "solver/prioritized/placing.h"

#include <algorithm>
#include <utility>

namespace split_mapf {
namespace {

// Keeps the weight of a whole path within 32 bits.
constexpr std::uint32_t kMostCounted = 1000;

}  // namespace

Placing::Placing(const Instance& instance, Effort& effort, std::vector<Path>& paths)
    : instance_(instance),
      effort_(effort),
      table_(instance.graph().size()),
      paths_(paths),
      search_(instance.graph()),
      weights_(instance.robots(), 1),
      demoted_(instance.robots(), 0) {}

std::vector<std::uint32_t> Placing::run(const std::vector<std::uint32_t>& order,
                                        std::uint64_t demotions, std::uint32_t horizon) {
  queue_.assign(order.begin(), order.end());
  std::vector<std::uint32_t> left_over;
  while (!queue_.empty()) {
    const std::uint32_t robot = queue_.front();
    queue_.pop_front();
    if (!place(robot, demotions, horizon)) left_over.push_back(robot);
    if (effort_.stopped()) break;
  }
  return left_over;
}

GapAnswer Placing::search(std::uint32_t robot, std::uint32_t horizon, bool demote) {
  EvictionQuery query;
  query.start = instance_.start(robot);
  query.distances = &instance_.distances(robot);
  query.placed = &table_;
  query.weights = demote ? &weights_ : nullptr;
  query.latest_arrival = horizon;
  GapAnswer answer = search_.search(query, effort_.deadline());
  if (!effort_.spend(answer.expansions, answer.interrupted)) answer.path.clear();
  return answer;
}

bool Placing::place(std::uint32_t robot, std::uint64_t demotions, std::uint32_t horizon) {
  Path path = search(robot, horizon, demotions > 0).path;
  if (path.empty()) return false;
  const std::vector<std::uint32_t> blockers = robotsInTheWay(table_.paths(), path);
  for (const std::uint32_t blocker : blockers) {
    if (demoted_[blocker] >= demotions) return false;
  }
  for (const std::uint32_t blocker : blockers) demote(blocker);
  table_.insert(robot, path);
  paths_[robot] = std::move(path);
  return true;
}

void Placing::demote(std::uint32_t robot) {
  table_.remove(robot, paths_[robot]);
  paths_[robot].clear();
  demoted_[robot] = std::min(demoted_[robot] + 1, kMostCounted);
  weights_[robot] = (1 + demoted_[robot]) * (1 + demoted_[robot]);
  queue_.push_back(robot);
}

}  // namespace split_mapf
