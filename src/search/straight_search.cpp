#include "search/straight_search.h"

#include <algorithm>

namespace split_mapf {

StraightSearch::StraightSearch(const HeadingGraph& graph, std::uint32_t vertices)
    : graph_(graph), states_(1), marks_(vertices) {}

/// A robot that may lose very many steps keeps its path until it has lost some.
void StraightSearch::begin() {
  const Path& own = *own_;
  arrival_ = static_cast<std::uint32_t>(own.size() - 1);
  begin_ = 0;
  Heading heading = kNoHeading;
  while (arrival_ - begin_ - (*distances_)(own[begin_]) > kMostLoss) {
    ++begin_;
    if (own[begin_] == own[begin_ - 1]) continue;
    heading = graph_.headingOf(own[begin_ - 1], own[begin_]);
  }
  most_ = std::min(ownCost(heading), HeadingCosts::kMost);
  mark_ += size_;
  if (mark_ > kNone / 2) {
    std::fill(marks_.begin(), marks_.end(), 0);
    mark_ = 1;
  }
  layers_.assign(1, 0);
  states_[0] = State();
  states_[0].costs = HeadingCosts(heading, 0);
  states_[0].vertex = own[begin_];
  size_ = 1;
}

/// @param heading  with which the robot stands at the beginning.
std::uint32_t StraightSearch::ownCost(Heading heading) const {
  const Path& own = *own_;
  std::uint32_t cost = 0;
  for (std::uint32_t t = begin_ + 1; t < own.size(); ++t) {
    if (own[t] == own[t - 1]) continue;
    const Heading next = graph_.headingOf(own[t - 1], own[t]);
    cost += HeadingCosts::kTurn * turnsBetween(heading, next) + placed_->countClose(own[t], t, own);
    heading = next;
  }
  return cost;
}

/// With which headings a path through it may cost little enough.
inline HeadingCosts::Headings StraightSearch::goesOn(const State& state) const {
  // No place has more than two turns left that are known of.
  constexpr std::uint32_t kLeft = 2 * HeadingCosts::kTurn;
  if (most_ >= kLeft && state.costs.within(most_ - kLeft) == HeadingCosts::kAll) {
    return HeadingCosts::kAll;
  }
  return state.costs.within(most_, graph_.turnsLeft(state.vertex, distances_->goal()));
}

/// Where a robot that waits need not go now: it could have gone there before at no greater cost,
/// and have waited there, as nobody is there now.
inline HeadingCosts::Headings StraightSearch::needNotMove(const State& state,
                                                          const OccupancyBySteps::Step& now,
                                                          Vertex own) const {
  HeadingCosts::Headings moves = state.made_before & state.costs.notBelow(state.costs_before);
  for (HeadingCosts::Headings left = moves; left != 0; left &= left - 1) {
    const Heading heading = HeadingCosts::firstOf(left);
    const Vertex to = graph_.next(state.vertex)[heading];
    if (now.isTaken(to) && own != to) moves ^= HeadingCosts::only(heading);
  }
  return moves;
}

/// The layer of the next step from the last one.
template <bool kMayLose, typename Distances>
void StraightSearch::makeLayer(const Distances& distances) {
  const std::uint32_t first = layers_.back();
  const std::uint32_t end = size_;
  const auto t = static_cast<std::uint32_t>(begin_ + layers_.size());
  layers_.push_back(end);
  // Each state leads to five at the most.
  const std::size_t room = end + 5 * std::size_t{end - first};
  if (states_.size() < room) states_.resize(2 * room);
  // What a loop would load again after each store.
  State* const states = states_.data();
  std::uint32_t* const marks = marks_.data();
  const std::uint32_t mark = mark_;
  std::uint32_t size = end;
  const OccupancyBySteps::Step soon = placed_->at(std::min(t + 1, arrival_));
  const auto reach = [&](Vertex v, HeadingCosts costs) -> State& {
    if (marks[v] >= mark + end) {
      State& state = states[marks[v] - mark];
      state.costs = state.costs.orLess(costs);
      return state;
    }
    marks[v] = mark + size;
    soon.prefetch(v);
    State& state = states[size++];
    state.costs = costs;
    state.made_before = 0;
    state.vertex = v;
    return state;
  };

  const OccupancyBySteps::Step now = placed_->at(t);
  const Vertex own = (*own_)[t];
  const Vertex own_before = (*own_)[t - 1];
  const Vertex own_after = positionAt(*own_, t + 1);
  const std::uint32_t left = arrival_ - t;
  for (std::uint32_t i = first; i < end; ++i) {
    const Vertex v = states[i].vertex;
    const HeadingCosts costs = states[i].costs;
    HeadingCosts::Headings headings = goesOn(states[i]);
    if (headings == 0) continue;
    const std::array<Vertex, 4>& next = graph_.next(v);
    HeadingCosts::Headings in_time = 0;
    for (Heading h = 0; h < 4; ++h) in_time |= HeadingCosts::only(h, distances(next[h]) <= left);
    HeadingCosts::Headings made = kMayLose ? needNotMove(states[i], now, own) : 0;
    headings &= in_time & ~made;
    const bool is_mine = !now.isTaken(v) || own == v;
    for (; headings != 0; headings &= headings - 1) {
      const Heading h = HeadingCosts::firstOf(headings);
      const Vertex to = next[h];
      if (now.isTaken(to) && own != to) continue;
      if (!is_mine && now.isEntered(v, opposite(h))) continue;  // they would change places
      const std::uint32_t close =
          own == to ? placed_->countClose(to, t, *own_)
                    : now.countBeside(to) - (own_before == to ? 1 : 0) - (own_after == to ? 1 : 0);
      reach(to, HeadingCosts(h, costs[h] + close));
      if (kMayLose && close == 0) made |= HeadingCosts::only(h);
    }
    if (!kMayLose || !is_mine || distances(v) > left) continue;
    State& waits = reach(v, costs);
    waits.costs_before = costs;
    waits.made_before = made;
  }
  size_ = size;
}

std::uint32_t StraightSearch::stateAt(Vertex v, std::uint32_t t) const {
  const std::uint32_t layer = t - begin_;
  for (std::uint32_t i = layers_[layer]; i < layers_[layer + 1]; ++i) {
    if (states_[i].vertex == v) return i;
  }
  return kNone;
}

bool StraightSearch::comeStraight(Place& place, std::uint32_t t) const {
  const State& at = states_[place.state];
  const Heading back = opposite(place.heading);
  const Vertex before = graph_.next(at.vertex)[back];
  const std::uint32_t last = before == at.vertex ? kNone : stateAt(before, t - 1);
  if (last == kNone) return false;
  const std::uint32_t close = placed_->countClose(at.vertex, t, *own_);
  if (states_[last].costs[place.heading] + close > at.costs[place.heading]) return false;
  if (placed_->at(t).isEntered(before, back) && (*own_)[t] != before) return false;
  place.state = last;
  return true;
}

bool StraightSearch::haveWaited(Place& place, std::uint32_t t) const {
  const State& at = states_[place.state];
  const std::uint32_t last = stateAt(at.vertex, t - 1);
  if (last == kNone || states_[last].costs[place.heading] > at.costs[place.heading]) return false;
  place.state = last;
  return true;
}

bool StraightSearch::haveTurned(Place& place) const {
  const HeadingCosts& costs = states_[place.state].costs;
  for (Heading heading = 0; heading < 4; ++heading) {
    const std::uint32_t turns = turnsBetween(heading, place.heading);
    if (turns == 0 || costs[heading] + HeadingCosts::kTurn * turns > costs[place.heading]) continue;
    place.heading = heading;
    return true;
  }
  return false;
}

/// From where and with which heading a state was reached, a step before.
bool StraightSearch::stepBack(Place& place, std::uint32_t t, TurnsLie lie) const {
  if (lie == TurnsLie::kLate) {
    while (haveTurned(place)) {
    }
    return comeStraight(place, t) || haveWaited(place, t);
  }
  do {
    if (comeStraight(place, t) || haveWaited(place, t)) return true;
  } while (haveTurned(place));
  return false;
}

Path StraightSearch::pathBack(TurnsLie lie) const {
  Path path = *own_;
  Place place = {size_ - 1, 0};
  const HeadingCosts& costs = states_[place.state].costs;
  while (costs[place.heading] != costs.least()) ++place.heading;
  for (std::uint32_t t = arrival_; t > begin_; --t) {
    path[t] = states_[place.state].vertex;
    if (!stepBack(place, t, lie)) return {};
  }
  while (path.size() > 1 && path[path.size() - 2] == path.back()) path.pop_back();
  return path;
}

Path StraightSearch::search(const Path& own, const DistanceTable& distances,
                            const OccupancyBySteps& placed, TurnsLie lie) {
  own_ = &own;
  distances_ = &distances;
  placed_ = &placed;
  begin();
  const std::uint16_t* const narrow = distances.narrowEntries();
  const auto entry = [narrow](Vertex v) -> std::uint32_t { return narrow[v]; };
  const bool may_lose = arrival_ - begin_ > distances(own[begin_]);
  for (std::uint32_t t = begin_; t < arrival_; ++t) {
    if (narrow == nullptr) {
      makeLayer<true>(distances);
    } else if (may_lose) {
      makeLayer<true>(entry);
    } else {
      makeLayer<false>(entry);
    }
    if (size_ == layers_.back()) return {};
  }
  // At the arrival the goal alone is left.
  layers_.push_back(size_);
  return states_[size_ - 1].costs.least() <= most_ ? pathBack(lie) : Path();
}

}  // namespace split_mapf
