#include "solver/lacam/lacam_search.h"

#include <algorithm>

#include "search/crowd.h"
#include "search/robot_order.h"
#include "solver/lacam/shortest_sequence.h"
#include "solver/lacam/turn_order.h"

namespace split_mapf {
namespace {

// Robots of a crowd that choose their paths side by side.
constexpr std::uint32_t kBatchOfCrowd = 8;
constexpr std::size_t kMebibyte = std::size_t{1} << 20;

}  // namespace

LacamSearch::LacamSearch(const Instance& instance, const LacamSettings& settings,
                         const LentThreads& threads, const Deadline& deadline)
    : instance_(instance),
      settings_(settings),
      threads_(threads),
      deadline_(deadline),
      engine_(settings.seed),
      explored_(instance.robots(), instance.graph().size()),
      orders_(instance.robots(), instance.robots()),
      next_(instance.robots(), kNoVertex),
      ranks_(makeOrder(instance, "longest_first", engine_)) {}

LacamSearch::Outcome LacamSearch::run() {
  const std::uint64_t rounds = settings_.guidance.value_or(isCrowd() ? LacamSettings::kRoundsOfCrowd
                                                                     : LacamSettings::kRounds);
  if (rounds > 0) makeGuidance(rounds);
  // Not before: the guidance holds the robots' tables one by one.
  distances_ = std::make_unique<RobotDistances>(instance_);
  pibt_ = std::make_unique<Pibt>(instance_, *distances_, guidance_.get(), settings_.swap,
                                 settings_.seed);
  addStart();
  while (goal_node_ == kNone) {
    if (front_ == kNone) return Outcome::kExhausted;
    if (deadline_.expired()) return Outcome::kInterrupted;
    if (isSpent()) return Outcome::kSpent;
    if (isFull()) return Outcome::kFull;
    load(front_);
    ConstraintQueue& constraints = nodes_[loaded_].constraints;
    const std::size_t bytes = constraints.bytes();
    if (!constraints.pop(instance_.graph(), from_, order_, engine_, next_)) {
      unlink(loaded_);
      nodes_[loaded_].exhausted = true;
      constraints.release();
    } else if (pibt_->complete(from_, order_, next_)) {
      const std::uint32_t reached = reach();
      if (atGoals(next_)) goal_node_ = reached;
    }
    constraint_bytes_ += nodes_[loaded_].constraints.bytes();
    constraint_bytes_ -= bytes;
  }
  return Outcome::kFound;
}

void LacamSearch::makeGuidance(std::uint64_t rounds) {
  ScatterOptions options;
  options.rounds = rounds;
  options.margin = static_cast<std::uint32_t>(settings_.margin);
  options.seed = settings_.seed;
  options.expansion_limit = settings_.expansion_limit;
  if (isCrowd()) {
    options.batch = kBatchOfCrowd;
    options.threads = threads_;
  }
  const ScatteredPaths scattered = scatterPaths(instance_, options, deadline_);
  guidance_expansions_ = scattered.expansions;
  guidance_ = std::make_unique<Guidance>(scattered.paths);
}

bool LacamSearch::isCrowd() const { return instance_.robots() >= kCrowd; }

void LacamSearch::addStart() {
  const Configuration& starts = instance_.starts();
  explored_.add(starts, hashOf(starts));
  orders_.append(ranks_);
  nodes_.emplace_back();
  pushFront(0);
  if (atGoals(starts)) goal_node_ = 0;
}

void LacamSearch::load(std::uint32_t node) {
  if (loaded_ == node) return;
  explored_.read(node, from_);
  orders_.read(node, order_);
  loaded_ = node;
}

bool LacamSearch::isSpent() const {
  return settings_.expansion_limit > 0 && expansions() > settings_.expansion_limit;
}

bool LacamSearch::isFull() {
  const std::size_t bytes = explored_.bytes() + orders_.bytes() + constraint_bytes_ +
                            nodes_.capacity() * sizeof(Node) +
                            shortcuts_.capacity() * sizeof shortcuts_[0];
  return bytes / kMebibyte >= settings_.memory;
}

std::uint32_t LacamSearch::reach() {
  std::uint64_t hash = explored_.hash(loaded_);
  for (std::uint32_t i = 0; i < next_.size(); ++i) {
    if (next_[i] != from_[i]) hash ^= placeHash(i, from_[i]) ^ placeHash(i, next_[i]);
  }
  if (const auto known = explored_.find(next_, hash)) {
    if (*known != loaded_) shortcuts_.emplace_back(loaded_, *known);
    if (!nodes_[*known].exhausted) {
      unlink(*known);
      pushFront(*known);
    }
    return *known;
  }
  const std::uint32_t added = explored_.add(next_, hash);
  orderTurns(next_, instance_.goals(), order_, ranks_, next_order_);
  orders_.append(next_order_);
  nodes_.emplace_back();
  nodes_[added].parent = loaded_;
  pushFront(added);
  return added;
}

bool LacamSearch::atGoals(const Configuration& configuration) const {
  return configuration == instance_.goals();
}

void LacamSearch::unlink(std::uint32_t node) {
  const Node& gone = nodes_[node];
  if (gone.above == kNone) {
    front_ = gone.below;
  } else {
    nodes_[gone.above].below = gone.below;
  }
  if (gone.below != kNone) nodes_[gone.below].above = gone.above;
}

void LacamSearch::pushFront(std::uint32_t node) {
  nodes_[node].above = kNone;
  nodes_[node].below = front_;
  if (front_ != kNone) nodes_[front_].above = node;
  front_ = node;
}

Plan LacamSearch::plan() const {
  std::vector<std::uint32_t> parents(nodes_.size());
  for (std::size_t n = 0; n < nodes_.size(); ++n) parents[n] = nodes_[n].parent;
  ExploredMoves moves{explored_, parents, shortcuts_};
  const std::vector<std::uint32_t> sequence =
      shortestSequence(instance_, moves, goal_node_, settings_.objective);
  Plan plan;
  plan.paths.resize(instance_.robots());
  Configuration configuration;
  for (const std::uint32_t node : sequence) {
    explored_.read(node, configuration);
    for (std::uint32_t i = 0; i < configuration.size(); ++i) {
      plan.paths[i].push_back(configuration[i]);
    }
  }
  trimToArrival(plan);
  return plan;
}

}  // namespace split_mapf
