#include "search/straight_search.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace split_mapf {

HeadingGraph::HeadingGraph(const Grid& grid) : places_(grid.size()) {
  for (Vertex v = 0; v < grid.size(); ++v) {
    const Cell at = grid.cellOf(v);
    Place& place = places_[v];
    place.x = static_cast<std::int16_t>(at.x);
    place.y = static_cast<std::int16_t>(at.y);
    for (const Vertex to : grid.graph().neighbours(v)) {
      const Cell cell = grid.cellOf(to);
      const bool straight = (cell.x == at.x) != (cell.y == at.y);
      const std::size_t heading = cell.x > at.x ? 0 : (cell.y > at.y ? 1 : (cell.x < at.x ? 2 : 3));
      Vertex& next = place.next[heading];
      valid_ = valid_ && straight && next == kNoVertex;
      next = to;
    }
  }
  if (!valid_) return;
  // Vertices are numbered by rows and columns.
  for (Vertex v = 0; v < grid.size(); ++v) {
    for (const Heading heading : {Heading{2}, Heading{3}}) measureRun(v, heading);
  }
  for (Vertex v = grid.size(); v-- > 0;) {
    for (const Heading heading : {Heading{0}, Heading{1}}) measureRun(v, heading);
  }
}

/// @pre it is known of the next vertex.
void HeadingGraph::measureRun(Vertex v, Heading heading) {
  Place& place = places_[v];
  if (place.next[heading] == kNoVertex) return;
  const Place& next = places_[place.next[heading]];
  const int cells = std::abs(next.x - place.x) + std::abs(next.y - place.y);
  place.run[heading] = static_cast<std::uint16_t>(next.run[heading] + cells);
}

std::array<std::uint8_t, 4> HeadingGraph::turnsLeft(Vertex v, Vertex goal) const {
  const Place& at = places_[v];
  const Place& end = places_[goal];
  const int east = end.x - at.x;
  const int south = end.y - at.y;
  // A goal straight ahead takes no turn, one that is met from a corner straight ahead takes one.
  const auto left = [&](Heading heading, int along, int across, Heading back) -> std::uint8_t {
    const bool comes_to_corner = along >= 0 && at.run[heading] >= along;
    if (!comes_to_corner || end.run[back] < std::abs(across)) return 2;
    return across == 0 ? 0 : 1;
  };
  const Heading north_or_south = south > 0 ? 3 : 1;  // from the goal to the row of `v`
  const Heading west_or_east = east > 0 ? 2 : 0;
  return {left(0, east, south, north_or_south), left(1, south, east, west_or_east),
          left(2, -east, south, north_or_south), left(3, -south, east, west_or_east)};
}

Heading HeadingGraph::headingOf(Vertex from, Vertex to) const {
  for (Heading heading = 0; heading < 4; ++heading) {
    if (next(from, heading) == to) return heading;
  }
  return kNoHeading;
}

StraightSearch::StraightSearch(const HeadingGraph& graph, std::uint32_t vertices)
    : graph_(graph), marks_(vertices) {}

/// A robot that may lose more steps than there are bits keeps its path until it has lost some.
void StraightSearch::begin(bool as_many) {
  const Path& own = *own_;
  ++search_;
  met_.clear();
  last_records_.clear();
  records_.clear();
  arrival_ = static_cast<std::uint32_t>(own.size() - 1);
  begin_ = 0;
  first_heading_ = kNoHeading;
  const auto loss = [&](std::uint32_t t) { return arrival_ - t - (*distances_)(own[t]); };
  while (loss(begin_) > kMostLoss) {
    ++begin_;
    if (own[begin_] == own[begin_ - 1]) continue;
    first_heading_ = graph_.headingOf(own[begin_ - 1], own[begin_]);
  }
  loss_ = loss(begin_);
  mask_ = ~std::uint64_t{0} >> (63 - loss_);
  most_turns_ = as_many ? 1 : 0;
  Heading heading = first_heading_;
  for (std::uint32_t t = begin_ + 1; t < own.size(); ++t) {
    if (own[t] == own[t - 1]) continue;
    const Heading next = graph_.headingOf(own[t - 1], own[t]);
    most_turns_ += turnsBetween(heading, next);
    heading = next;
  }
  if (levels_.size() < most_turns_ + std::size_t{3}) levels_.resize(most_turns_ + std::size_t{3});
  for (std::vector<Item>& level : levels_) level.clear();
  for (const Vertex v : own) marks_[v].own_in = search_;
}

/// The bits of the steps at which the robot is at `v` on its own path.
std::uint64_t StraightSearch::ownBits(Vertex v, std::int32_t base) const {
  std::uint64_t bits = 0;
  const std::uint32_t before = base < 0 ? static_cast<std::uint32_t>(-base) : 0;
  for (std::uint32_t bit = before; bit <= loss_ + 1; ++bit) {
    const auto t = static_cast<std::uint32_t>(base + static_cast<std::int32_t>(bit));
    if (positionAt(*own_, t) == v) bits |= std::uint64_t{1} << bit;
  }
  return bits;
}

std::uint64_t StraightSearch::freeBits(Vertex v, std::int32_t base) const {
  const std::uint32_t before = base < 0 ? static_cast<std::uint32_t>(-base) : 0;
  if (before > kMostLoss + 1) return 0;
  const std::uint32_t first = base < 0 ? 0 : static_cast<std::uint32_t>(base);
  std::uint64_t taken = placed_->taken(v, first / 64) >> (first % 64);
  if (first % 64 != 0) taken |= placed_->taken(v, first / 64 + 1) << (64 - first % 64);
  return (~taken << before) & (mask_ << 1U | 1U);
}

std::uint32_t StraightSearch::meet(Vertex v) {
  Mark& mark = marks_[v];
  if (mark.met_in == search_) return mark.met;
  mark.met_in = search_;
  mark.met = static_cast<std::uint32_t>(met_.size());
  Met& met = met_.emplace_back();
  met.vertex = v;
  met.base =
      static_cast<std::int32_t>(arrival_ - loss_) - static_cast<std::int32_t>((*distances_)(v));
  met.free = freeBits(v, met.base);
  if (mark.own_in == search_) met.free |= ownBits(v, met.base);
  met.turns_left = graph_.turnsLeft(v, distances_->goal());
  last_records_.push_back({kNone, kNone, kNone, kNone});
  return mark.met;
}

void StraightSearch::push(const Item& item) {
  if (item.bits == 0) return;
  const std::uint32_t turns = item.turns + met_[item.met].turns_left[item.heading];
  if (turns < most_turns_) levels_[turns].push_back(item);
}

/// The steps at which a robot comes to `to` that leaves `from` a step after each of `bits`.
std::uint64_t StraightSearch::move(const Met& from, const Met& to, std::uint64_t bits) const {
  const std::uint32_t shift = shiftOf(from, to);
  std::uint64_t moved = (bits << shift) & to.free & mask_;
  // Only where somebody comes to `from` right then who may have stood at `to`.
  const std::uint64_t comes = (bits & ~(from.free >> 1U)) << shift;
  std::uint64_t doubtful = comes & (~to.free << 1U | 1U) & moved;
  while (doubtful != 0) {
    const std::uint64_t bit = doubtful & (0 - doubtful);
    doubtful ^= bit;
    const auto step =
        static_cast<std::uint32_t>(to.base + static_cast<std::int32_t>(__builtin_ctzll(bit)));
    const Stay* const stay = placed_->oncoming(from.vertex, to.vertex, step);
    if (stay != nullptr && stay->robot != robot_) moved ^= bit;
  }
  return moved;
}

void StraightSearch::moveAhead(const Item& item, std::uint64_t bits) {
  const Vertex next = graph_.next(met_[item.met].vertex, item.heading);
  if (next == kNoVertex) return;
  const std::uint32_t to = meet(next);
  const std::uint64_t moved = move(met_[item.met], met_[to], bits);
  push({moved & ~met_[to].reached[item.heading], to, item.turns, item.heading, false});
}

/// Right where it is, in no time.
void StraightSearch::turn(const Item& item, std::uint64_t bits) {
  const Met& met = met_[item.met];
  for (const Heading by : {Heading{1}, Heading{2}, Heading{3}}) {
    const auto heading = static_cast<Heading>((item.heading + by) % 4U);
    const std::uint64_t news = bits & ~met.reached[heading];
    if (news == 0) continue;
    const std::uint32_t turns = item.turns + turnsBetween(item.heading, heading);
    const std::uint32_t level = turns + met.turns_left[heading];
    if (level >= most_turns_ || graph_.next(met.vertex, heading) == kNoVertex) continue;
    levels_[level].push_back({news, item.met, turns, heading, true});
  }
}

/// @return whether the robot is at its goal at its arrival.
bool StraightSearch::expand(const Item& item) {
  Met& met = met_[item.met];
  const std::uint64_t free = met.free & mask_;
  // It may wait as long as nobody comes: the sum carries each bit through the free ones above it.
  const std::uint64_t stays = ((free + item.bits) ^ free) & free;
  const std::uint64_t bits = (stays | item.bits) & ~met.reached[item.heading];
  if (bits == 0) return false;
  met.reached[item.heading] |= bits;
  std::uint32_t& last_record = last_records_[item.met][item.heading];
  records_.push_back({bits, item.turns, last_record});
  last_record = static_cast<std::uint32_t>(records_.size() - 1);
  if (met.vertex == distances_->goal() && (bits >> loss_ & 1U) != 0) return true;
  // Who has just turned does not turn again.
  if (!item.turned) turn(item, bits);
  moveAhead(item, bits);
  return false;
}

std::uint32_t StraightSearch::turnsAt(const State& state) const {
  std::uint32_t r = last_records_[state.met][state.heading];
  while (r != kNone && (records_[r].bits >> state.bit & 1U) == 0) r = records_[r].next;
  return r == kNone ? kNone : records_[r].turns;
}

bool StraightSearch::comeStraight(State& state) const {
  const Met& at = met_[state.met];
  const Vertex before = graph_.next(at.vertex, (state.heading + 2) % 4);
  if (before == kNoVertex || marks_[before].met_in != search_) return false;
  const Met& from = met_[marks_[before].met];
  const std::uint32_t shift = shiftOf(from, at);
  if (state.bit < shift) return false;
  const State last = {marks_[before].met, state.bit - shift, state.heading};
  const bool may =
      turnsAt(last) <= turnsAt(state) && move(from, at, std::uint64_t{1} << last.bit) != 0;
  if (may) state = last;
  return may;
}

bool StraightSearch::haveWaited(State& state) const {
  const State last = {state.met, state.bit - 1, state.heading};
  const bool may = state.bit > 0 && turnsAt(last) <= turnsAt(state);
  if (may) state = last;
  return may;
}

bool StraightSearch::haveTurned(State& state) const {
  const std::uint32_t turns = turnsAt(state);
  for (Heading heading = 0; heading < 4; ++heading) {
    const State last = {state.met, state.bit, heading};
    const std::uint32_t then = heading == state.heading ? kNone : turnsAt(last);
    if (then == kNone || then + turnsBetween(heading, state.heading) > turns) continue;
    state = last;
    return true;
  }
  return false;
}

/// From where and with which heading a state was reached, a step before.
bool StraightSearch::stepBack(State& state, TurnsLie lie) const {
  if (lie == TurnsLie::kLate) {
    while (haveTurned(state)) {
    }
    return comeStraight(state) || haveWaited(state);
  }
  do {
    if (comeStraight(state) || haveWaited(state)) return true;
  } while (haveTurned(state));
  return false;
}

Path StraightSearch::pathTo(Heading heading, TurnsLie lie) const {
  Path path = *own_;
  State state = {marks_[distances_->goal()].met, loss_, heading};
  for (std::uint32_t t = arrival_; t > begin_; --t) {
    path[t] = met_[state.met].vertex;
    if (!stepBack(state, lie)) return {};
  }
  while (path.size() > 1 && path[path.size() - 2] == path.back()) path.pop_back();
  return path;
}

Path StraightSearch::search(std::uint32_t robot, const Path& own, const DistanceTable& distances,
                            const ReservationTable& placed, bool as_many, TurnsLie lie) {
  robot_ = robot;
  own_ = &own;
  distances_ = &distances;
  placed_ = &placed;
  begin(as_many);
  if (most_turns_ == 0) return {};
  const std::uint32_t first = meet(own[begin_]);
  for (Heading heading = 0; heading < 4; ++heading) {
    if (first_heading_ != kNoHeading && heading != first_heading_) continue;
    push({1, first, 0, heading, first_heading_ == kNoHeading});
  }
  for (std::uint32_t turns = 0; turns < most_turns_; ++turns) {
    while (!levels_[turns].empty()) {
      const Item item = levels_[turns].back();
      levels_[turns].pop_back();
      if (expand(item)) return pathTo(item.heading, lie);
    }
  }
  return {};
}

}  // namespace split_mapf
