#include "solver/ilp/node_queue.h"

#include <cmath>

namespace split_mapf::ilp {
namespace {

// Far above the rounding errors of a sum of a thousand terms, far below what a bound means.
constexpr double kRounding = 1e-6;

}  // namespace

double roundUp(double bound) { return std::ceil(bound - kRounding); }

NodeQueue::NodeQueue(double bound) {
  nodes_.push_back({kRoot, 0, bound, {}});
  open_.push({roundUp(bound), 0, kRoot});
}

void NodeQueue::open(std::uint32_t parent, const Decision& decision, double bound) {
  const std::uint32_t depth = nodes_[parent].depth + 1;
  open_.push({roundUp(bound), depth, static_cast<std::uint32_t>(nodes_.size())});
  nodes_.push_back({parent, depth, bound, decision});
}

std::uint32_t NodeQueue::take() {
  const std::uint32_t number = open_.top().node;
  open_.pop();
  return number;
}

void NodeQueue::gather(std::uint32_t number, const Instance& instance,
                       std::vector<RobotRules>& rules) const {
  rules.assign(instance.robots(), {});
  for (; number != kRoot; number = nodes_[number].parent) {
    apply(nodes_[number].decision, instance, rules);
  }
}

}  // namespace split_mapf::ilp
