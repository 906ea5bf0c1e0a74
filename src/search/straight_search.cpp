#include "search/straight_search.h"

#include <algorithm>
#include <utility>

namespace split_mapf {

HeadingGraph::HeadingGraph(const Grid& grid)
    : grid_(grid), next_(4 * std::size_t{grid.size()}, kNoVertex) {
  for (Vertex v = 0; v < grid.size(); ++v) {
    const Cell at = grid.cellOf(v);
    for (const Vertex to : grid.graph().neighbours(v)) {
      const Cell cell = grid.cellOf(to);
      const bool straight = (cell.x == at.x) != (cell.y == at.y);
      const std::size_t heading = cell.x > at.x ? 0 : (cell.y > at.y ? 1 : (cell.x < at.x ? 2 : 3));
      Vertex& next = next_[4 * std::size_t{v} + heading];
      valid_ = valid_ && straight && next == kNoVertex;
      next = to;
    }
  }
}

Heading HeadingGraph::headingOf(Vertex from, Vertex to) const {
  for (Heading heading = 0; heading < 4; ++heading) {
    if (next(from, heading) == to) return heading;
  }
  return kNoHeading;
}

StraightSearch::StraightSearch(const HeadingGraph& graph, std::uint32_t vertices)
    : graph_(graph), slot_(vertices, 0), stamp_(vertices, 0) {}

/// A robot that may lose more steps than there are bits keeps its path until it has lost some.
void StraightSearch::begin(const Path& own, std::uint32_t more) {
  ++search_;
  met_.clear();
  records_.clear();
  arrival_ = static_cast<std::uint32_t>(own.size() - 1);
  goal_ = graph_.cellOf(distances_->goal());
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
  most_turns_ = more;
  Heading heading = first_heading_;
  for (std::uint32_t t = begin_ + 1; t < own.size(); ++t) {
    if (own[t] == own[t - 1]) continue;
    const Heading next = graph_.headingOf(own[t - 1], own[t]);
    most_turns_ += turnsBetween(heading, next);
    heading = next;
  }
  if (levels_.size() < most_turns_ + std::size_t{3}) levels_.resize(most_turns_ + std::size_t{3});
  for (std::vector<Item>& level : levels_) level.clear();
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
  if (stamp_[v] == search_) return slot_[v];
  stamp_[v] = search_;
  slot_[v] = static_cast<std::uint32_t>(met_.size());
  Met met;
  met.vertex = v;
  met.base =
      static_cast<std::int32_t>(arrival_ - loss_) - static_cast<std::int32_t>((*distances_)(v));
  met.free = freeBits(v, met.base);
  const Cell cell = graph_.cellOf(v);
  met.east = goal_.x - cell.x;
  met.south = goal_.y - cell.y;
  met_.push_back(met);
  return slot_[v];
}

/// How many it takes at least, on a grid without obstacles.
std::uint32_t StraightSearch::turnsLeft(const Met& met, Heading heading) const {
  if (heading == kNoHeading) return met.east != 0 && met.south != 0 ? 1 : 0;
  const std::int32_t along = heading % 2 == 0 ? met.east : met.south;
  const std::int32_t across = heading % 2 == 0 ? met.south : met.east;
  if (heading < 2 ? along < 0 : along > 0) return 2;
  return across != 0 ? 1 : 0;
}

void StraightSearch::push(const Item& item) {
  if (item.bits == 0) return;
  const std::uint32_t turns = item.turns + turnsLeft(met_[item.met], item.heading);
  if (turns < most_turns_) levels_[turns].push_back(item);
}

/// The steps at which a robot comes to `to` that leaves `from` a step after each of `bits`.
std::uint64_t StraightSearch::move(const Met& from, const Met& to, std::uint64_t bits) const {
  const std::uint32_t shift = shiftOf(from, to);
  std::uint64_t moved = (bits << shift) & to.free & mask_;
  // Only where somebody comes to `from` right then may it be who stood at `to`.
  std::uint64_t doubtful = ((bits & ~(from.free >> 1U)) << shift) & moved;
  while (doubtful != 0) {
    const std::uint64_t bit = doubtful & (0 - doubtful);
    doubtful ^= bit;
    const auto step =
        static_cast<std::uint32_t>(to.base + static_cast<std::int32_t>(__builtin_ctzll(bit)));
    if (placed_->oncoming(from.vertex, to.vertex, step) != nullptr) moved ^= bit;
  }
  return moved;
}

/// @return whether the robot is at its goal at its arrival.
bool StraightSearch::expand(const Item& item) {
  const std::uint64_t free = met_[item.met].free & mask_;
  std::uint64_t bits = item.bits;
  // It may wait as long as nobody comes: fills runs of free steps upwards.
  for (std::uint64_t more = bits; more != 0;) {
    more = (more << 1U) & free & ~bits;
    bits |= more;
  }
  Met& met = met_[item.met];
  bits &= ~met.reached[item.heading];
  if (bits == 0) return false;
  met.reached[item.heading] |= bits;
  records_.push_back({bits, item.turns, met.records[item.heading]});
  met.records[item.heading] = static_cast<std::uint32_t>(records_.size() - 1);
  const Vertex v = met.vertex;
  if (v == distances_->goal() && (bits >> loss_ & 1U) != 0) return true;
  for (Heading heading = 0; heading < 4; ++heading) {
    const Vertex next = graph_.next(v, heading);
    if (next == kNoVertex) continue;
    const std::uint32_t sum = item.turns + turnsBetween(item.heading, heading);
    if (sum >= most_turns_) continue;
    const std::uint32_t to = meet(next);
    const std::uint64_t moved = move(met_[item.met], met_[to], bits);
    push({to, sum, moved & ~met_[to].reached[heading], heading});
  }
  return false;
}

std::uint32_t StraightSearch::turnsAt(const Met& met, Heading heading, std::uint32_t bit) const {
  for (std::uint32_t r = met.records[heading]; r != kNone; r = records_[r].next) {
    if ((records_[r].bits >> bit & 1U) != 0) return records_[r].turns;
  }
  return kNone;
}

/// From where and with which heading a state was reached, a step before.
bool StraightSearch::stepBack(std::uint32_t& met, Heading& heading, std::uint32_t& bit) const {
  const Met& at = met_[met];
  const std::uint32_t turns = turnsAt(at, heading, bit);
  // Moves first, so that waits lie early: there the fewest others come by.
  const Vertex before =
      heading == kNoHeading ? kNoVertex : graph_.next(at.vertex, (heading + 2) % 4);
  if (before != kNoVertex && stamp_[before] == search_) {
    const Met& from = met_[slot_[before]];
    const std::uint32_t shift = shiftOf(from, at);
    const bool may = bit >= shift && move(from, at, std::uint64_t{1} << (bit - shift)) != 0;
    for (Heading last = 0; may && last <= kNoHeading; ++last) {
      const std::uint32_t then = turnsAt(from, last, bit - shift);
      if (then == kNone || then + turnsBetween(last, heading) > turns) continue;
      met = slot_[before];
      heading = last;
      bit -= shift;
      return true;
    }
  }
  if (bit == 0 || turnsAt(at, heading, bit - 1) > turns) return false;
  --bit;
  return true;
}

Path StraightSearch::pathTo(const Path& own, Heading heading) const {
  Path path = own;
  std::uint32_t met = slot_[distances_->goal()];
  std::uint32_t bit = loss_;
  for (std::uint32_t t = arrival_; t > begin_; --t) {
    path[t] = met_[met].vertex;
    if (!stepBack(met, heading, bit)) return {};
  }
  while (path.size() > 1 && path[path.size() - 2] == path.back()) path.pop_back();
  return path;
}

Path StraightSearch::search(const Path& own, const DistanceTable& distances,
                            const ReservationTable& placed, std::uint32_t more) {
  distances_ = &distances;
  placed_ = &placed;
  begin(own, more);
  if (most_turns_ == 0) return {};
  push({meet(own[begin_]), 0, 1, first_heading_});
  for (std::uint32_t turns = 0; turns < most_turns_; ++turns) {
    while (!levels_[turns].empty()) {
      const Item item = levels_[turns].back();
      levels_[turns].pop_back();
      if (expand(item)) return pathTo(own, item.heading);
    }
  }
  return {};
}

}  // namespace split_mapf
