#include "support/oracle.h"

#include <limits>
#include <stdexcept>
#include <vector>

namespace split_mapf::test {
namespace {

constexpr std::uint32_t kUnseen = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t kMostStates = 1U << 22;

/// Uniform-cost search over joint states. A robot's part of a state is its vertex, or "retired":
/// at its goal and never to move again. A step costs 1 (makespan) or 1 a robot that has not
/// retired (sum of costs); retiring on arrival is a free choice of each robot.
class JointSearch {
 public:
  JointSearch(const Instance& instance, Objective objective)
      : instance_(instance),
        robots_(instance.robots()),
        retired_(instance.graph().size()),
        may_retire_(objective == Objective::kSumOfCosts) {
    std::uint64_t states = 1;
    for (std::uint32_t i = 0; i < robots_; ++i) states *= retired_ + 1;
    if (states > kMostStates) throw std::invalid_argument("too large for the oracle");
    costs_.assign(states, kUnseen);
    parts_.resize(robots_);
    next_.resize(robots_);
  }

  std::optional<std::uint64_t> run() {
    std::vector<std::uint32_t> start(robots_);
    for (std::uint32_t i = 0; i < robots_; ++i) start[i] = instance_.start(i);
    pushWithRetirements(0, start, 0);
    for (std::uint32_t cost = 0; cost < buckets_.size(); ++cost) {
      for (std::size_t i = 0; i < buckets_[cost].size(); ++i) {
        const std::uint64_t state = buckets_[cost][i];
        if (costs_[state] != cost) continue;
        decode(state);
        if (isFinal()) return cost;
        move(0, cost + stepCost());
      }
      buckets_[cost] = {};
    }
    return std::nullopt;
  }

 private:
  std::uint32_t vertexOf(std::uint32_t robot, std::uint32_t part) const {
    return part == retired_ ? instance_.goal(robot) : part;
  }

  bool isFinal() const {
    for (std::uint32_t i = 0; i < robots_; ++i) {
      if (may_retire_ ? parts_[i] != retired_ : parts_[i] != instance_.goal(i)) return false;
    }
    return true;
  }

  std::uint32_t stepCost() const {
    if (!may_retire_) return 1;
    std::uint32_t cost = 0;
    for (const std::uint32_t part : parts_) cost += part == retired_ ? 0 : 1;
    return cost;
  }

  /// Chooses the next vertices of robots i, i+1, ... of parts_ in every legal way.
  void move(std::uint32_t i, std::uint32_t cost) {
    if (i == robots_) {
      pushWithRetirements(0, next_, cost);
      return;
    }
    if (parts_[i] == retired_) {
      tryNext(i, retired_, cost);
      return;
    }
    tryNext(i, parts_[i], cost);
    for (const Vertex v : instance_.graph().neighbours(parts_[i])) tryNext(i, v, cost);
  }

  void tryNext(std::uint32_t i, std::uint32_t part, std::uint32_t cost) {
    const std::uint32_t from = vertexOf(i, parts_[i]);
    const std::uint32_t to = vertexOf(i, part);
    for (std::uint32_t j = 0; j < i; ++j) {
      const std::uint32_t other_from = vertexOf(j, parts_[j]);
      const std::uint32_t other_to = vertexOf(j, next_[j]);
      if (to == other_to || (to == other_from && from == other_to)) return;
    }
    next_[i] = part;
    move(i + 1, cost);
  }

  /// Pushes the state, and those in which further robots at their goals retire.
  void pushWithRetirements(std::uint32_t i, std::vector<std::uint32_t> parts, std::uint32_t cost) {
    for (; may_retire_ && i < robots_; ++i) {
      if (parts[i] != instance_.goal(i)) continue;
      std::vector<std::uint32_t> other = parts;
      other[i] = retired_;
      pushWithRetirements(i + 1, std::move(other), cost);
    }
    std::uint64_t state = 0;
    for (const std::uint32_t part : parts) state = state * (retired_ + 1) + part;
    if (costs_[state] <= cost) return;
    costs_[state] = cost;
    if (buckets_.size() <= cost) buckets_.resize(cost + 1);
    buckets_[cost].push_back(state);
  }

  void decode(std::uint64_t state) {
    for (std::uint32_t i = robots_; i-- > 0;) {
      parts_[i] = static_cast<std::uint32_t>(state % (retired_ + 1));
      state /= retired_ + 1;
    }
  }

  const Instance& instance_;
  std::uint32_t robots_;
  std::uint32_t retired_;  // the part of a robot that has arrived for good
  bool may_retire_;
  std::vector<std::uint32_t> costs_;  // state -> least known cost
  std::vector<std::vector<std::uint64_t>> buckets_;
  std::vector<std::uint32_t> parts_;
  std::vector<std::uint32_t> next_;
};

}  // namespace

std::optional<std::uint64_t> optimalCost(const Instance& instance, Objective objective) {
  return JointSearch(instance, objective).run();
}

}  // namespace split_mapf::test
