#include "solver/lacam/crowd_walk.h"

#include <utility>

#include "search/robot_order.h"
#include "solver/lacam/turn_order.h"

namespace split_mapf {
namespace {

// One in so many is left to the search, which also parts those who block each other for good.
constexpr std::uint32_t kLeftOneIn = 100;
// Nobody in a crowd that flows takes as many times the longest of the shortest ways.
constexpr std::uint32_t kLongest = 3;

CrowdState stateAtStart(const Instance& instance) {
  CrowdState state;
  state.at = instance.starts();
  state.home_since.resize(instance.robots());
  state.waited.resize(instance.robots());
  for (std::uint32_t i = 0; i < instance.robots(); ++i) {
    state.home_since[i] = instance.start(i) == instance.goal(i) ? 0 : CrowdState::kAway;
  }
  return state;
}

std::vector<std::uint32_t> longestFirst(const Instance& instance) {
  RandomEngine unused;
  return makeOrder(instance, "longest_first", unused);
}

}  // namespace

CrowdWalk::CrowdWalk(const Instance& instance, const CrowdWalkOptions& options,
                     const Deadline& deadline)
    : instance_(instance),
      options_(options),
      deadline_(deadline),
      longest_(kLongest * makespanLowerBound(instance)),
      distances_(instance),
      state_(stateAtStart(instance)),
      guides_(instance, distances_, state_, options.guides),
      pibt_(instance, distances_, nullptr, false, options.guides.seed, &guides_),
      ranks_(longestFirst(instance)),
      order_(ranks_) {
  plan_.paths.resize(instance.robots());
  for (std::uint32_t i = 0; i < instance.robots(); ++i) {
    plan_.paths[i].push_back(instance.start(i));
    if (state_.isAway(i)) ++away_;
  }
}

bool CrowdWalk::goesOn() const {
  return std::uint64_t{away_} * kLeftOneIn > instance_.robots() && state_.step < longest_;
}

bool CrowdWalk::isSpent() const {
  return options_.expansion_limit > 0 && expansions() > options_.expansion_limit;
}

/// @pre !isSpent().
std::uint64_t CrowdWalk::guidesMay() const {
  return options_.expansion_limit > 0 ? options_.expansion_limit - pibt_.expansions() : 0;
}

CrowdWalk::Outcome CrowdWalk::run() {
  Configuration next(instance_.robots());
  while (goesOn()) {
    if (deadline_.expired()) return Outcome::kInterrupted;
    if (isSpent()) return Outcome::kSpent;
    if (state_.step % options_.interval == 0 && !guides_.renew(deadline_, guidesMay())) {
      return deadline_.expired() ? Outcome::kInterrupted : Outcome::kSpent;
    }
    next.assign(next.size(), kNoVertex);
    if (!pibt_.complete(state_.at, order_, next)) break;
    take(next);
  }
  return Outcome::kDone;
}

void CrowdWalk::take(const Configuration& next) {
  ++state_.step;
  away_ = 0;
  for (std::uint32_t i = 0; i < next.size(); ++i) {
    const Vertex before = std::exchange(state_.at[i], next[i]);
    plan_.paths[i].push_back(next[i]);
    std::uint32_t& waited = state_.waited[i];
    if (next[i] == instance_.goal(i)) {
      if (state_.isAway(i)) state_.home_since[i] = state_.step;
      waited = 0;
      continue;
    }
    ++away_;
    if (!state_.isAway(i)) {
      state_.home_since[i] = CrowdState::kAway;
      guides_.forget(i);
    }
    if (next[i] == before) {
      ++waited;
    } else if (waited > 0 && distances_(i, next[i]) < distances_(i, before)) {
      waited -= waited > 1 ? 2 : 1;
    }
  }
  orderTurns(state_.at, instance_.goals(), order_, ranks_, next_order_);
  order_.swap(next_order_);
}

}  // namespace split_mapf
