#include "solver/conflict_optimizer/placement.h"

#include <algorithm>
#include <utility>

namespace split_mapf {
namespace {

// Keeps the weight of a whole path within 32 bits.
constexpr std::uint32_t kMostQueued = 1000;
constexpr std::uint32_t kLongestDelay = 20;

}  // namespace

Placement::Placement(const Instance& instance, const std::vector<std::uint32_t>& queue,
                     std::uint64_t seed)
    : instance_(instance),
      engine_(seed),
      search_(instance.graph()),
      table_(instance.graph().size()),
      queued_(instance.robots(), 0),
      weights_(instance.robots(), 1) {
  plan_.paths.resize(instance.robots());
  for (const std::uint32_t robot : queue) requeue(robot);
}

Placement::Placement(const Instance& instance, const Plan& plan, std::uint32_t horizon,
                     std::uint64_t seed)
    : Placement(instance, {}, seed) {
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    const Path& path = plan.paths[robot];
    if (path.size() - 1 > horizon) {
      requeue(robot);
    } else {
      plan_.paths[robot] = path;
      table_.insert(robot, path);
    }
  }
}

void Placement::requeue(std::uint32_t robot) {
  queue_.push_back(robot);
  queued_[robot] = std::min(queued_[robot] + 1, kMostQueued);
  weights_[robot] = queued_[robot] * queued_[robot];
}

void Placement::remove(std::uint32_t robot) {
  table_.remove(robot, plan_.paths[robot]);
  plan_.paths[robot].clear();
}

std::uint32_t Placement::drawDeparture(std::uint32_t robot, std::uint32_t horizon,
                                       std::uint32_t one_in) {
  if (one_in == 0 || drawBelow(engine_, one_in) > 0) return 0;
  const std::uint32_t length = instance_.shortestLength(robot);
  if (length == 0) return 0;  // its arrival is step 0, whatever it waits
  const std::uint32_t slack = horizon - length;
  return static_cast<std::uint32_t>(drawBelow(engine_, std::min(slack, kLongestDelay) + 1));
}

Placement::Outcome Placement::run(std::uint32_t horizon, const Effort& effort,
                                  const Deadline& deadline) {
  EvictionQuery query;
  query.placed = &table_;
  query.weights = &weights_;
  query.latest_arrival = horizon;
  std::size_t fewest = queue_.size();
  for (std::uint64_t left = effort.patience; !queue_.empty(); --left) {
    if (queue_.size() < fewest) {
      fewest = queue_.size();
      left = effort.patience;
    }
    if (left == 0) return Outcome::kSpent;
    if (effort.expansion_limit > 0 && expansions_ > effort.expansion_limit) {
      return Outcome::kExhausted;
    }
    if (deadline.expired()) return Outcome::kInterrupted;
    const std::uint32_t robot = queue_.front();
    query.start = instance_.start(robot);
    query.distances = &instance_.distances(robot);
    query.departure = drawDeparture(robot, horizon, effort.delayed_one_in);
    EvictionAnswer answer = search_.search(query, deadline);
    expansions_ += answer.expansions;
    if (answer.interrupted) return Outcome::kInterrupted;
    queue_.pop_front();
    for (const std::uint32_t other : robotsInTheWay(table_, answer.path)) {
      remove(other);
      requeue(other);
    }
    table_.insert(robot, answer.path);
    plan_.paths[robot] = std::move(answer.path);
  }
  return Outcome::kDone;
}

}  // namespace split_mapf
