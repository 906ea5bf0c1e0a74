#include "solver/ecbs/constraint_tree.h"

#include <algorithm>

namespace split_mapf {

std::uint32_t ConstraintTree::addPath(Path path) {
  paths_.push_back(std::move(path));
  return static_cast<std::uint32_t>(paths_.size()) - 1;
}

std::uint32_t ConstraintTree::add(TreeNode node) {
  const auto number = static_cast<std::uint32_t>(nodes_.size());
  open_.push({node.lower_bound, node.cost, number});
  waiting_.push({std::max(node.cost, node.lower_bound), node.lower_bound, number});
  nodes_.push_back(std::move(node));
  return number;
}

void ConstraintTree::dropClosed(Queue& queue) {
  while (!queue.empty() && nodes_[queue.top().node].closed) queue.pop();
}

bool ConstraintTree::empty() {
  dropClosed(open_);
  return open_.empty();
}

std::uint64_t ConstraintTree::lowerBound() {
  dropClosed(open_);
  return open_.top().key;
}

std::uint32_t ConstraintTree::lowest() {
  dropClosed(open_);
  return open_.top().node;
}

std::uint32_t ConstraintTree::best() {
  const std::uint64_t most = limit(lowerBound());
  while (!waiting_.empty() && waiting_.top().key <= most) {
    const std::uint32_t number = waiting_.top().node;
    waiting_.pop();
    if (nodes_[number].closed) continue;
    focal_.push({nodes_[number].conflicts.size(), nodes_[number].cost, number});
  }
  dropClosed(focal_);
  // The node of the least lower bound keeps each robot within its own limit, so FOCAL holds it.
  return focal_.top().node;
}

void ConstraintTree::close(std::uint32_t number) {
  nodes_[number].closed = true;
  nodes_[number].conflicts.clear();
  nodes_[number].conflicts.shrink_to_fit();
}

void ConstraintTree::reopen(std::uint32_t number, std::uint64_t lower_bound) {
  TreeNode node = std::move(nodes_[number]);
  close(number);
  node.lower_bound = lower_bound;
  add(std::move(node));
}

void ConstraintTree::gatherConstraints(std::uint32_t number, std::uint32_t robot,
                                       RobotConstraints& out) const {
  for (std::uint32_t i = number; nodes_[i].parent != TreeNode::kNoParent; i = nodes_[i].parent) {
    if (nodes_[i].constraint.robot == robot) apply(nodes_[i].constraint, out);
  }
}

}  // namespace split_mapf
