#include "solver/joint/joint_search.h"

#include <algorithm>
#include <utility>

namespace split_mapf {
namespace {

// Collisions decide between states of equal bounds, then the steps that are left.
constexpr std::uint32_t kBitsOfLeft = 40;
constexpr std::uint32_t kStatesAPoll = 64;

/// The greatest surplus in a portion of moves: twice as wide each time, or states would wait again
/// and again where the bound is far below what a plan costs.
std::uint32_t portion(std::uint32_t least) { return least < 2 ? least : 2 * least - 1; }

std::uint64_t costLimit(const JointTask& task, const JointSettings& settings) {
  // Costs are counted in 32 bits.
  std::uint64_t limit = std::min<std::uint64_t>(task.cost_limit, 0xfffffff0U);
  if (ruleOf(settings.objective).greatest_only) {
    limit = std::min<std::uint64_t>(limit, std::uint64_t{settings.latest_arrival} + 1);
  }
  return limit;
}

/// Whether the step at which robots are somewhere matters for what they can do.
bool isTimed(const JointTask& task, const JointSettings& settings) {
  const bool late = ruleOf(settings.objective).sums() && settings.latest_arrival != kForever;
  return late || task.firm_until > 0;
}

/// The greatest number that a part of a state takes.
std::uint32_t greatestPart(const Instance& instance, const JointTask& task,
                           const JointSettings& settings) {
  std::uint32_t greatest = std::max(instance.graph().size(), task.firm_until);
  if (settings.latest_arrival != kForever) greatest = std::max(greatest, settings.latest_arrival);
  return greatest;
}

}  // namespace

JointSearch::JointSearch(const Instance& instance, JointTask task, const JointSettings& settings,
                         const Deadline& deadline)
    : instance_(instance),
      task_(std::move(task)),
      settings_(settings),
      deadline_(deadline),
      ended_(instance.graph().size()),
      timed_(isTimed(task_, settings)),
      limit_(costLimit(task_, settings)),
      floor_(static_cast<std::uint32_t>(task_.floor)),
      explored_(robots() + (timed_ ? 1 : 0), greatestPart(instance, task_, settings) + 1),
      moves_(robots(), settings.expansion_limit, deadline),
      row_(robots() + (timed_ ? 1 : 0)),
      next_(row_) {
  for (const std::uint32_t robot : task_.robots) {
    distances_.push_back(instance.distances(robot));
    goals_.push_back(instance.goal(robot));
  }
}

JointSearch::Outcome JointSearch::run() {
  bound_ = limit_;
  if (!findFreeGoals()) return Outcome::kNone;
  pushStarts(0);
  const Outcome outcome = search();
  if (outcome == Outcome::kNone) bound_ = limit_;
  return outcome;
}

bool JointSearch::findFreeGoals() {
  free_from_.assign(robots(), 0);
  if (task_.others == nullptr) return true;
  for (std::uint32_t i = 0; i < robots(); ++i) {
    for (const Stay& stay : task_.others->at(goals_[i])) {
      if (task_.firm.empty() || task_.firm[stay.robot] == 0) continue;
      if (stay.end == kForever) return false;
      free_from_[i] = std::max(free_from_[i], stay.end);
    }
    // Who arrives for good arrives after all who pass there.
    if (!sums()) floor_ = std::max(floor_, free_from_[i]);
  }
  return true;
}

std::uint32_t JointSearch::stepsLeft(std::uint32_t i, std::uint32_t part) const {
  if (part == ended_) return 0;
  if (sums() && part == goals_[i]) return 2;  // it leaves and comes back, or it would have ended
  return (*distances_[i])(part);
}

std::uint32_t JointSearch::stepPart(std::uint32_t depth) const {
  const bool ever = sums() && settings_.latest_arrival != kForever;
  return ever ? depth : std::min(depth, task_.firm_until);
}

/// Puts robots i, i+1, ... at their starts: one that is at home has ended, or not.
void JointSearch::pushStarts(std::uint32_t i) {
  if (full_) return;
  if (i < robots()) {
    next_[i] = instance_.start(task_.robots[i]);
    pushStarts(i + 1);
    if (sums() && instance_.start(task_.robots[i]) == goals_[i] && free_from_[i] == 0) {
      next_[i] = ended_;
      pushStarts(i + 1);
    }
    return;
  }
  Node node;
  std::uint64_t left = 0;
  std::uint32_t most_left = 0;
  std::uint64_t hash = timed_ ? placeHash(robots(), 0) : 0;
  if (timed_) next_[robots()] = 0;
  for (std::uint32_t j = 0; j < robots(); ++j) {
    const std::uint32_t steps = stepsLeft(j, next_[j]);
    left += steps;
    most_left = std::max(most_left, steps);
    hash ^= placeHash(j, next_[j]);
  }
  if (most_left > settings_.latest_arrival) return;
  node.bound = sums() ? static_cast<std::uint32_t>(left) : std::max(floor_, most_left);
  full_ = !push(node, left, hash);
}

JointSearch::Outcome JointSearch::search() {
  std::uint32_t rounds = 0;
  while (!open_.empty()) {
    if (full_) return Outcome::kFull;
    const Entry entry = open_.top();
    open_.pop();
    const Node& node = nodes_[entry.node];
    if (node.bound != entry.bound || node.progress != entry.progress) continue;
    bound_ = entry.bound;
    if (rounds++ % kStatesAPoll == 0 && deadline_.expired()) return Outcome::kInterrupted;
    if (load(node, entry.node)) {
      goal_ = entry.node;
      return Outcome::kFound;
    }
    const Outcome outcome = expand(entry.node);
    if (outcome != Outcome::kNone) return outcome;
  }
  return full_ ? Outcome::kFull : Outcome::kNone;
}

bool JointSearch::load(const Node& node, std::uint32_t number) {
  explored_.read(number, row_);
  active_ = 0;
  most_left_ = 0;
  left_ = 0;
  for (std::uint32_t i = 0; i < robots(); ++i) {
    const std::uint32_t steps = stepsLeft(i, row_[i]);
    active_ += row_[i] != ended_ ? 1 : 0;
    most_left_ = std::max(most_left_, steps);
    left_ += steps;
  }
  if (sums()) return active_ == 0;
  return left_ == 0 && node.depth >= *std::max_element(free_from_.begin(), free_from_.end());
}

/// kNone: the search goes on.
JointSearch::Outcome JointSearch::expand(std::uint32_t number) {
  const Node node = nodes_[number];
  more_ = false;
  for (std::uint32_t i = 0; i < robots(); ++i) offerMoves(i, node);
  MoveWindow window;
  if (moves_.prepare()) {
    window = windowOf(node);
    const bool all = moves_.forEach(
        window, [&](const JointMoves&) { return pushChild(number, node.cost + left_); });
    if (!all) {
      if (full_) return Outcome::kFull;
      return moves_.spent() ? Outcome::kSpent : Outcome::kInterrupted;
    }
    postpone(number, window);
  } else {
    raiseBound(number, more_ && !sums(), node.bound + 1, 0);
  }
  return Outcome::kNone;
}

MoveWindow JointSearch::windowOf(const Node& node) const {
  const std::uint32_t least = std::max(node.progress, moves_.leastSurplus());
  if (sums()) {
    const auto own = static_cast<std::uint32_t>(node.bound - node.cost - left_);
    return {node.progress, std::max(own, portion(least)), false};
  }
  return {least, portion(least), node.bound > std::max(floor_, node.cost + most_left_)};
}

void JointSearch::offerMoves(std::uint32_t i, const Node& node) {
  const std::uint32_t part = row_[i];
  moves_.begin(i, vertexOf(i, part));
  offer(i, node, part);
  if (part == ended_) return;
  for (const Vertex v : instance_.graph().neighbours(part)) {
    offer(i, node, v);
    if (sums() && v == goals_[i] && node.depth + 1 >= free_from_[i]) offer(i, node, ended_);
  }
}

void JointSearch::offer(std::uint32_t i, const Node& node, std::uint32_t part) {
  MoveOption option;
  option.part = part;
  option.to = vertexOf(i, part);
  option.left = stepsLeft(i, part);
  const std::uint32_t step = node.depth + 1;
  if (sums()) {
    if (std::uint64_t{step} + option.left > settings_.latest_arrival) return;
  } else if (step + option.left > node.bound) {
    more_ = true;
    return;
  }
  option.late = step + option.left == node.bound;
  if (row_[i] != ended_) option.surplus = 1 + option.left - stepsLeft(i, row_[i]);
  option.collisions = collisionsOf(vertexOf(i, row_[i]), option.to, step);
  if (option.collisions == kBlocked) return;
  option.hash = placeHash(i, part);
  moves_.add(i, option);
}

std::uint32_t JointSearch::collisionsOf(Vertex from, Vertex to, std::uint32_t step) const {
  if (task_.others == nullptr) return 0;
  std::uint32_t collisions = 0;
  for (const Stay& stay : task_.others->at(to)) {
    if (stay.begin > step) break;
    const bool meets = step < stay.end || (stay.end == step && stay.next == from && from != to);
    if (!meets) continue;
    if (!task_.firm.empty() && task_.firm[stay.robot] != 0) return kBlocked;
    ++collisions;
  }
  return collisions;
}

bool JointSearch::pushChild(std::uint32_t parent, std::uint64_t base) {
  const Node& from = nodes_[parent];
  Node child;
  child.parent = parent;
  child.depth = from.depth + 1;
  child.cost = from.cost + (sums() ? active_ : 1);
  child.collisions = from.collisions + moves_.collisions();
  std::uint32_t most_left = 0;
  for (std::uint32_t i = 0; i < robots(); ++i) {
    const MoveOption& option = moves_.chosen(i);
    next_[i] = option.part;
    most_left = std::max(most_left, option.left);
  }
  std::uint64_t hash = moves_.hash();
  if (timed_) {
    next_[robots()] = stepPart(child.depth);
    hash ^= placeHash(robots(), next_[robots()]);
  }
  child.bound = sums() ? static_cast<std::uint32_t>(base + moves_.surplus())
                       : std::max(floor_, child.cost + most_left);
  const std::uint64_t left = left_ + moves_.surplus() - (sums() ? active_ : robots());
  full_ = !push(child, left, hash);
  return !full_;
}

bool JointSearch::push(const Node& node, std::uint64_t left, std::uint64_t hash) {
  if (node.bound >= limit_) return true;
  const std::optional<std::uint32_t> known = explored_.find(next_, hash);
  if (!known) {
    if (explored_.size() >= settings_.states) return false;
    nodes_.push_back(node);
    open(explored_.add(next_, hash), left);
    return true;
  }
  Node& old = nodes_[*known];
  const bool waits = old.progress == 0 && old.bound == node.bound;
  const bool better =
      node.cost < old.cost || (node.cost == old.cost && waits && node.collisions < old.collisions);
  if (!better) return true;
  old = node;
  open(*known, left);
  return true;
}

void JointSearch::open(std::uint32_t number, std::uint64_t left) {
  const Node& node = nodes_[number];
  open_.push(
      {node.bound, node.progress, (std::uint64_t{node.collisions} << kBitsOfLeft) + left, number});
}

void JointSearch::postpone(std::uint32_t number, const MoveWindow& done) {
  const bool rest = moves_.mostSurplus() > done.most;
  const Node& node = nodes_[number];
  if (sums()) {
    const std::uint64_t base = node.cost + left_;
    return raiseBound(number, rest, static_cast<std::uint32_t>(base + done.most + 1),
                      done.most + 1);
  }
  if (!rest) return raiseBound(number, more_, node.bound + 1, 0);
  nodes_[number].progress = done.most + 1;
  open(number, left_ + nodes_[number].progress - robots());
}

void JointSearch::raiseBound(std::uint32_t number, bool more, std::uint32_t bound,
                             std::uint32_t progress) {
  Node& node = nodes_[number];
  if (!more || bound >= limit_) {
    node.progress = kClosed;
    return;
  }
  node.bound = bound;
  node.progress = progress;
  open(number, left_);
}

std::vector<Path> JointSearch::paths() const {
  Plan plan;
  plan.paths.resize(robots());
  Configuration row(row_.size());
  for (std::uint32_t number = goal_; number != kNoParent; number = nodes_[number].parent) {
    explored_.read(number, row);
    for (std::uint32_t i = 0; i < robots(); ++i) plan.paths[i].push_back(vertexOf(i, row[i]));
  }
  for (Path& path : plan.paths) std::reverse(path.begin(), path.end());
  trimToArrival(plan);
  return std::move(plan.paths);
}

}  // namespace split_mapf
