#include "search/safe_interval_search.h"

#include <algorithm>

namespace split_mapf {
namespace {

// Collisions beyond this number are not told apart, which bounds the bucket array.
constexpr std::uint32_t kMostConflicts = 63;
// Collisions that one step beyond the firm arrival weighs.
constexpr std::uint32_t kFirmWeight = 8;
constexpr std::uint64_t kPollEvery = 1024;
// The number of no robot, planned or reserved.
constexpr std::uint32_t kNoRobotAtAll = 0xffffffffU;
// States for which there is room from the start.
constexpr std::size_t kStatesAVertex = 32;
constexpr std::size_t kMostReserved = std::size_t{1} << 20;

/// The first segment that ends behind `step`; `count` if there is none. Without branches to guess,
/// which would cost more than all else in the search.
std::uint32_t firstEndingAfter(const Segment* segments, std::uint32_t count, std::uint32_t step) {
  std::uint32_t first = 0;
  for (std::uint32_t left = count; left > 1;) {
    const std::uint32_t half = left / 2;
    first += half * static_cast<std::uint32_t>(segments[first + half - 1].end <= step);
    left -= half;
  }
  return first + (first < count && segments[first].end <= step ? 1 : 0);
}

}  // namespace

SafeIntervalSearch::SafeIntervalSearch(const Graph& graph) : graph_(graph), met_(graph.size()) {
  // Address space, not memory: growing would touch fresh pages at every doubling.
  queue_.reserve(std::min<std::size_t>(std::size_t{graph.size()} * kStatesAVertex, kMostReserved));
}

SearchAnswer SafeIntervalSearch::search(const SearchQuery& query, const Deadline& deadline) {
  query_ = &query;
  flat_ = query.distances->narrowEntries();
  SearchAnswer answer;
  reset();
  if (!prepareGoal() || !pushStart()) return answer;
  while (!queue_.empty()) {
    const std::uint32_t index = queue_.pop();
    const State state = queue_[index];
    if (state.kind == Kind::kArrival) {
      answer.path = queue_.pathTo(index);
      return answer;
    }
    if (state.kind == Kind::kLater) {
      const State source = queue_[state.parent];
      expandMoves(source, state.parent, state.time);
      continue;
    }
    if (!close(state)) continue;
    if (++answer.expansions % kPollEvery == 0 && deadline.expired()) {
      answer.interrupted = true;
      return answer;
    }
    expand(index);
  }
  return answer;
}

void SafeIntervalSearch::reset() {
  queue_.clear();
  best_.clear();
  own_count_ = 0;
  if (++search_number_ == 0) {
    for (Meeting& meeting : met_) meeting.search = 0;
    search_number_ = 1;
  }
}

bool SafeIntervalSearch::close(const State& state) {
  Best& best = best_[state.place];
  if (state.time >= best.closed_time) return false;
  best.closed_time = state.time;
  return true;
}

const SafeIntervalSearch::Meeting& SafeIntervalSearch::meet(Vertex v) {
  Meeting& meeting = met_[v];
  if (meeting.search == search_number_) return meeting;
  meeting.search = search_number_;
  const Timeline& timeline = timelineOf(v);
  meeting.first_place = static_cast<std::uint32_t>(best_.size());
  meeting.count = static_cast<std::uint32_t>(timeline.size());
  meeting.segments = timeline.data();
  best_.resize(best_.size() + timeline.size());
  return meeting;
}

const Timeline& SafeIntervalSearch::timelineOf(Vertex v) {
  static const Timeline undisturbed = {{0, kForever, 0, 0}};
  const Timeline* timeline = &undisturbed;
  if (query_->mode != OthersAre::kIgnored) {
    const std::vector<Stay>& stays = query_->others->at(v);
    const bool holds_robot = std::any_of(
        stays.begin(), stays.end(), [&](const Stay& stay) { return stay.robot == query_->robot; });
    if (holds_robot) {
      Timeline& own = ownTimeline();
      builder_.build(stays, query_->robot, own);
      timeline = &own;
    } else {
      timeline = &query_->others->timeline(v);
    }
  }
  if (query_->reserved != nullptr) timeline = &withoutReserved(v, *timeline);
  if (query_->constraints == nullptr || !query_->constraints->bansAt(v)) return *timeline;
  Timeline& cut = ownTimeline();
  cut = *timeline;
  cutBans(v, *query_->constraints, cut);
  return cut;
}

const Timeline& SafeIntervalSearch::withoutReserved(Vertex v, const Timeline& timeline) {
  const std::vector<Stay>& stays = query_->reserved->at(v);
  if (stays.empty()) return timeline;
  RobotConstraints bans;
  for (const Stay& stay : stays) bans.vertex_bans.push_back({v, stay.begin, stay.end});
  Timeline& cut = ownTimeline();
  cut = timeline;
  cutBans(v, bans, cut);
  return cut;
}

Timeline& SafeIntervalSearch::ownTimeline() {
  if (own_count_ == own_timelines_.size()) own_timelines_.emplace_back();
  return own_timelines_[own_count_++];
}

bool SafeIntervalSearch::prepareGoal() {
  const Meeting& goal = meet(query_->distances->goal());
  const Segment* segments = goal.segments;
  if (goal.count == 0) return false;
  std::uint32_t i = goal.count - 1;
  if (segments[i].end != kForever) return false;
  collisions_after_.assign(goal.count, 0);
  for (; i > 0 && segments[i - 1].end == segments[i].begin; --i) {
    collisions_after_[i - 1] = collisions_after_[i] + segments[i].entering;
  }
  earliest_hold_ = segments[i].begin;
  if (query_->constraints != nullptr) {
    earliest_hold_ = std::max(earliest_hold_, query_->constraints->earliest_arrival);
  }
  return true;
}

bool SafeIntervalSearch::pushStart() {
  const std::uint32_t distance = distanceOf(query_->start);
  if (distance == DistanceTable::kUnreachable) return false;
  first_estimate_ = estimateOf(0, distance);
  if (first_estimate_ > query_->latest_arrival) return false;
  // Where collisions are not counted there is one row of buckets, and it grows with its need.
  const bool counted = query_->mode == OthersAre::kCounted;
  estimates_ = counted ? query_->latest_arrival - first_estimate_ + 1 : 0;
  queue_.reserveKeys(static_cast<std::size_t>(kMostConflicts + 1) * estimates_);

  const Meeting& at = meet(query_->start);
  if (at.count == 0 || at.segments[0].begin > 0) return false;
  State start;
  start.place = at.first_place;
  start.vertex = query_->start;
  start.time = 0;
  start.parent = kNone;
  start.conflicts = at.segments[0].present;
  start.kind = Kind::kVisit;
  if (distance == 0 && earliest_hold_ == 0) {
    State arrived = start;
    arrived.kind = Kind::kArrival;
    arrived.conflicts = static_cast<std::uint16_t>(arrived.conflicts + collisions_after_[0]);
    push(arrived, first_estimate_);
  }
  push(start, first_estimate_);
  return true;
}

std::uint32_t SafeIntervalSearch::estimateOf(std::uint32_t time, std::uint32_t distance) const {
  return std::max(time + distance, earliest_hold_);
}

std::uint32_t SafeIntervalSearch::weightOf(std::uint32_t conflicts, std::uint32_t estimate) const {
  std::uint32_t weight = conflicts;
  if (estimate > query_->cheap_arrival) {
    const std::uint32_t steps = estimate - query_->cheap_arrival;
    weight += (steps + query_->steps_a_collision - 1) / query_->steps_a_collision;
  }
  if (estimate > query_->firm_arrival) weight += kFirmWeight * (estimate - query_->firm_arrival);
  return std::min(weight, kMostConflicts);
}

void SafeIntervalSearch::push(const State& state, std::uint32_t estimate) {
  std::size_t key = estimate - first_estimate_;
  if (query_->mode == OthersAre::kCounted) {
    key += std::size_t{weightOf(state.conflicts, estimate)} * estimates_;
  }
  queue_.push(state, key);
}

void SafeIntervalSearch::pushVisit(const State& state, std::uint32_t distance) {
  const std::uint32_t estimate = estimateOf(state.time, distance);
  if (estimate > query_->latest_arrival) return;
  Best& best = best_[state.place];
  if (state.time >= best.closed_time) return;
  if (state.time >= best.pushed_time && state.conflicts >= best.pushed_conflicts) return;
  if (best.pushed_conflicts >= state.conflicts) {
    best.pushed_time = state.time;
    best.pushed_conflicts = state.conflicts;
  }
  push(state, estimate);
}

void SafeIntervalSearch::pushLater(const State& state, std::uint32_t index, std::uint32_t time) {
  // A move ends at most one step closer to the goal.
  const std::uint32_t distance = distanceOf(state.vertex);
  const std::uint32_t estimate = estimateOf(time, distance > 0 ? distance - 1 : 0);
  if (estimate > query_->latest_arrival) return;
  State later = state;
  later.time = time;
  later.parent = index;
  later.kind = Kind::kLater;
  push(later, estimate);
}

void SafeIntervalSearch::expand(std::uint32_t index) {
  const State state = queue_[index];
  const Meeting& at = met_[state.vertex];
  expandWait(state, at.segments[state.place - at.first_place], index);
  expandMoves(state, index, state.time + 1);
}

void SafeIntervalSearch::expandWait(const State& state, const Segment& segment,
                                    std::uint32_t index) {
  const Meeting& at = met_[state.vertex];
  const std::uint32_t number = state.place - at.first_place + 1;
  if (number >= at.count) return;
  const Segment& next = at.segments[number];
  if (next.begin != segment.end) return;
  State waited = state;
  ++waited.place;
  waited.time = next.begin;
  waited.parent = index;
  waited.conflicts = static_cast<std::uint16_t>(state.conflicts + next.entering);
  pushVisit(waited, distanceOf(state.vertex));
}

void SafeIntervalSearch::expandMoves(const State& state, std::uint32_t index, std::uint32_t from) {
  const Meeting& here = met_[state.vertex];
  const std::uint32_t leave_by = here.segments[state.place - here.first_place].end;
  const bool at_once = from == state.time + 1;
  std::uint32_t later = kForever;
  for (const Vertex to : graph_.neighbours(state.vertex)) {
    const std::uint32_t distance = distanceOf(to);
    if (distance > query_->latest_arrival || from + distance > query_->latest_arrival) continue;
    const Meeting& there = meet(to);
    std::uint32_t number = firstEndingAfter(there.segments, there.count, from);
    if (number < there.count && there.segments[number].begin <= from) {
      const bool open = at_once || there.segments[number].begin == from;
      if (open) enter(state, index, to, number, from);
      ++number;
    }
    if (number < there.count) later = std::min(later, there.segments[number].begin);
  }
  if (later <= leave_by && later < kForever) pushLater(state, index, later);
}

bool SafeIntervalSearch::isMoveBanned(Vertex from, Vertex to, std::uint32_t step) const {
  if (query_->constraints != nullptr && query_->constraints->bansMove(from, to, step)) return true;
  return query_->reserved != nullptr &&
         query_->reserved->countSwaps(kNoRobotAtAll, from, to, step) > 0;
}

bool SafeIntervalSearch::firstAllowed(Vertex from, Vertex to, std::uint32_t& time,
                                      std::uint32_t last) const {
  const bool has_bans = query_->constraints != nullptr && !query_->constraints->move_bans.empty();
  if (!has_bans && query_->reserved == nullptr) return time <= last;
  while (time <= last && isMoveBanned(from, to, time)) ++time;
  return time <= last;
}

std::uint32_t SafeIntervalSearch::swaps(const State& state, Vertex to, const Segment& there,
                                        std::uint32_t time) const {
  // Who swaps with the robot leaves `to` and enters its own vertex: there both timelines are cut.
  if (time != there.begin || query_->mode == OthersAre::kIgnored) return 0;
  const Meeting& here = met_[state.vertex];
  if (time != here.segments[state.place - here.first_place].end) return 0;
  return query_->others->countSwaps(query_->robot, state.vertex, to, time);
}

void SafeIntervalSearch::enter(const State& state, std::uint32_t index, Vertex to,
                               std::uint32_t number, std::uint32_t time) {
  const Meeting& here = met_[state.vertex];
  const Meeting& at = met_[to];
  const Segment& there = at.segments[number];
  const std::uint32_t leave_by = here.segments[state.place - here.first_place].end;
  const std::uint32_t last = std::min(leave_by, there.end - 1);
  if (to == query_->distances->goal()) arrive(state, index, number, time, last);
  if (!firstAllowed(state.vertex, to, time, last)) return;
  const std::uint32_t met = swaps(state, to, there, time);
  State entered = state;
  entered.place = at.first_place + number;
  entered.vertex = to;
  entered.time = time;
  entered.parent = index;
  entered.conflicts = static_cast<std::uint16_t>(state.conflicts + there.present + met);
  pushVisit(entered, distanceOf(to));
}

void SafeIntervalSearch::arrive(const State& state, std::uint32_t index, std::uint32_t number,
                                std::uint32_t time, std::uint32_t last) {
  const Vertex goal = query_->distances->goal();
  time = std::max(time, earliest_hold_);
  if (!firstAllowed(state.vertex, goal, time, std::min(last, query_->latest_arrival))) return;
  const Meeting& at = met_[goal];
  const Segment& there = at.segments[number];
  const std::uint32_t met = swaps(state, goal, there, time);
  State arrived = state;
  arrived.place = at.first_place + number;
  arrived.vertex = goal;
  arrived.time = time;
  arrived.parent = index;
  arrived.conflicts =
      static_cast<std::uint16_t>(state.conflicts + there.present + met + collisions_after_[number]);
  arrived.kind = Kind::kArrival;
  push(arrived, time);
}

}  // namespace split_mapf
