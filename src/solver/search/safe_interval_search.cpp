#include "solver/search/safe_interval_search.h"

#include <algorithm>

namespace split_mapf {
namespace {

// Collisions beyond this number are not told apart, which bounds the bucket array.
constexpr std::uint32_t kMostConflicts = 63;
// Collisions that one step beyond the firm arrival weighs.
constexpr std::uint32_t kFirmWeight = 8;
constexpr std::uint64_t kPollEvery = 1024;

}  // namespace

SafeIntervalSearch::SafeIntervalSearch(const Graph& graph)
    : graph_(graph),
      met_(graph.size(), 0),
      first_segment_(graph.size(), 0),
      segment_count_(graph.size(), 0) {}

SearchAnswer SafeIntervalSearch::search(const SearchQuery& query, const Deadline& deadline) {
  query_ = &query;
  SearchAnswer answer;
  reset();
  if (!prepareGoal() || !pushStart()) return answer;
  while (queued_ > 0) {
    const std::uint32_t index = pop();
    const State& state = states_[index];
    if (state.segment == kNone) {
      answer.path = reconstruct(index);
      return answer;
    }
    Best& best = best_[state.segment];
    if (state.time >= best.closed_time) continue;
    best.closed_time = state.time;
    if (++answer.expansions % kPollEvery == 0 && deadline.expired()) {
      answer.interrupted = true;
      return answer;
    }
    expand(index);
  }
  return answer;
}

void SafeIntervalSearch::reset() {
  if (!buckets_.empty()) {
    std::fill(
        buckets_.begin(),
        buckets_.begin() + static_cast<std::ptrdiff_t>(std::min(last_bucket_ + 1, buckets_.size())),
        kNone);
  }
  states_.clear();
  segments_.clear();
  best_.clear();
  current_bucket_ = last_bucket_ = queued_ = 0;
  if (++search_number_ == 0) {
    std::fill(met_.begin(), met_.end(), 0);
    search_number_ = 1;
  }
}

std::uint32_t SafeIntervalSearch::segmentsOf(Vertex v, std::uint32_t& count) {
  if (met_[v] != search_number_) {
    met_[v] = search_number_;
    first_segment_[v] = static_cast<std::uint32_t>(segments_.size());
    builder_.build(v, query_->robot, query_->others, query_->mode, query_->constraints, segments_);
    segment_count_[v] = static_cast<std::uint32_t>(segments_.size()) - first_segment_[v];
    best_.resize(segments_.size());
  }
  count = segment_count_[v];
  return first_segment_[v];
}

bool SafeIntervalSearch::prepareGoal() {
  std::uint32_t count = 0;
  goal_first_segment_ = segmentsOf(query_->distances->goal(), count);
  if (count == 0 || segments_[goal_first_segment_ + count - 1].end != kForever) return false;
  collisions_after_.assign(count, 0);
  std::uint32_t i = count - 1;
  while (i > 0 &&
         segments_[goal_first_segment_ + i - 1].end == segments_[goal_first_segment_ + i].begin) {
    collisions_after_[i - 1] = collisions_after_[i] + segments_[goal_first_segment_ + i].entering;
    --i;
  }
  earliest_hold_ = segments_[goal_first_segment_ + i].begin;
  if (query_->constraints != nullptr) {
    earliest_hold_ = std::max(earliest_hold_, query_->constraints->earliest_arrival);
  }
  return true;
}

bool SafeIntervalSearch::pushStart() {
  const std::uint32_t distance = (*query_->distances)(query_->start);
  if (distance == DistanceTable::kUnreachable) return false;
  first_estimate_ = estimateOf(0, distance);
  if (first_estimate_ > query_->latest_arrival) return false;
  // Where collisions are not counted there is one row of buckets, and it grows with its need.
  const bool counted = query_->mode == OthersAre::kCounted;
  estimates_ = counted ? query_->latest_arrival - first_estimate_ + 1 : 0;
  const std::size_t needed = static_cast<std::size_t>(kMostConflicts + 1) * estimates_;
  if (buckets_.size() < needed) buckets_.resize(needed, kNone);

  std::uint32_t count = 0;
  const std::uint32_t first = segmentsOf(query_->start, count);
  if (count == 0 || segments_[first].begin > 0) return false;
  const State start{first, query_->start, 0, kNone, segments_[first].present, kNone};
  if (distance == 0 && earliest_hold_ == 0) {
    State arrived = start;
    arrived.segment = kNone;
    arrived.conflicts += collisions_after_[0];
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
  std::size_t bucket = estimate - first_estimate_;
  if (query_->mode == OthersAre::kCounted) {
    bucket += static_cast<std::size_t>(weightOf(state.conflicts, estimate)) * estimates_;
  } else if (bucket >= buckets_.size()) {
    buckets_.resize(2 * bucket + 64, kNone);
  }
  const auto index = static_cast<std::uint32_t>(states_.size());
  states_.push_back(state);
  states_.back().next = buckets_[bucket];
  buckets_[bucket] = index;
  current_bucket_ = std::min(current_bucket_, bucket);
  last_bucket_ = std::max(last_bucket_, bucket);
  ++queued_;
}

std::uint32_t SafeIntervalSearch::pop() {
  while (buckets_[current_bucket_] == kNone) ++current_bucket_;
  const std::uint32_t index = buckets_[current_bucket_];
  buckets_[current_bucket_] = states_[index].next;
  --queued_;
  return index;
}

void SafeIntervalSearch::pushToSegment(const State& state, std::uint32_t distance) {
  if (distance == DistanceTable::kUnreachable) return;
  const std::uint32_t estimate = estimateOf(state.time, distance);
  if (estimate > query_->latest_arrival) return;
  Best& best = best_[state.segment];
  if (state.time >= best.closed_time) return;
  if (state.time >= best.pushed_time && state.conflicts >= best.pushed_conflicts) return;
  if (best.pushed_conflicts >= state.conflicts) {
    best.pushed_time = state.time;
    best.pushed_conflicts = state.conflicts;
  }
  push(state, estimate);
}

void SafeIntervalSearch::expand(std::uint32_t index) {
  const State state = states_[index];
  expandWait(state, index);
  for (const Vertex to : graph_.neighbours(state.vertex)) expandMoves(state, index, to);
}

void SafeIntervalSearch::expandWait(const State& state, std::uint32_t index) {
  const std::uint32_t next = state.segment + 1;
  if (next >= first_segment_[state.vertex] + segment_count_[state.vertex]) return;
  if (segments_[next].begin != segments_[state.segment].end) return;
  pushToSegment({next, state.vertex, segments_[next].begin, index,
                 state.conflicts + segments_[next].entering, kNone},
                (*query_->distances)(state.vertex));
}

void SafeIntervalSearch::expandMoves(const State& state, std::uint32_t index, Vertex to) {
  const std::uint32_t leave_by = segments_[state.segment].end;  // latest step to arrive elsewhere
  std::uint32_t count = 0;
  const std::uint32_t first = segmentsOf(to, count);
  const bool is_goal = to == query_->distances->goal();
  for (std::uint32_t segment = first; segment < first + count; ++segment) {
    const Segment& there = segments_[segment];
    if (there.end <= state.time + 1) continue;
    if (there.begin > leave_by) break;
    const Window window{std::max(state.time + 1, there.begin), std::min(leave_by, there.end - 1)};
    if (window.first > window.last) continue;
    if (is_goal) tryArrive(state, index, segment, window);
    tryEnter(state, index, to, segment, window);
  }
}

bool SafeIntervalSearch::firstAllowed(Vertex from, Vertex to, Window window,
                                      std::uint32_t& time) const {
  const bool banned_moves =
      query_->constraints != nullptr && !query_->constraints->move_bans.empty();
  const bool avoid_swaps = query_->mode == OthersAre::kObstacles;
  for (time = window.first; time <= window.last; ++time) {
    if (banned_moves && query_->constraints->bansMove(from, to, time)) continue;
    if (avoid_swaps && swaps(from, to, time) > 0) continue;
    return true;
  }
  return false;
}

std::uint32_t SafeIntervalSearch::swaps(Vertex from, Vertex to, std::uint32_t time) const {
  return query_->others->countSwaps(query_->robot, from, to, time);
}

void SafeIntervalSearch::tryEnter(const State& state, std::uint32_t index, Vertex to,
                                  std::uint32_t segment, Window window) {
  const std::uint32_t distance = (*query_->distances)(to);
  std::uint32_t time = 0;
  if (!firstAllowed(state.vertex, to, window, time)) return;
  State entered{segment, to, time, index, state.conflicts + segments_[segment].present, kNone};
  if (query_->mode != OthersAre::kCounted) return pushToSegment(entered, distance);
  const std::uint32_t met = swaps(state.vertex, to, time);
  entered.conflicts += met;
  pushToSegment(entered, distance);
  // Coming a little later may avoid the swap.
  while (met > 0 && time < window.last) {
    if (!firstAllowed(state.vertex, to, {time + 1, window.last}, time)) return;
    if (swaps(state.vertex, to, time) > 0) continue;
    entered.time = time;
    entered.conflicts -= met;
    return pushToSegment(entered, distance);
  }
}

void SafeIntervalSearch::tryArrive(const State& state, std::uint32_t index, std::uint32_t segment,
                                   Window window) {
  window.first = std::max(window.first, earliest_hold_);
  std::uint32_t time = 0;
  if (window.first > window.last) return;
  if (!firstAllowed(state.vertex, query_->distances->goal(), window, time)) return;
  if (time > query_->latest_arrival) return;
  State arrived{kNone,
                query_->distances->goal(),
                time,
                index,
                state.conflicts + segments_[segment].present +
                    collisions_after_[segment - goal_first_segment_],
                kNone};
  if (query_->mode != OthersAre::kCounted) return push(arrived, time);
  const std::uint32_t met = swaps(state.vertex, arrived.vertex, time);
  arrived.conflicts += met;
  push(arrived, time);
  while (met > 0 && time < window.last) {
    if (!firstAllowed(state.vertex, arrived.vertex, {time + 1, window.last}, time)) return;
    if (time > query_->latest_arrival) return;
    if (swaps(state.vertex, arrived.vertex, time) > 0) continue;
    arrived.time = time;
    arrived.conflicts -= met;
    return push(arrived, time);
  }
}

Path SafeIntervalSearch::reconstruct(std::uint32_t index) const {
  Path path(states_[index].time + 1);
  std::uint32_t until = states_[index].time;
  path[until] = states_[index].vertex;
  for (std::uint32_t i = states_[index].parent; i != kNone; i = states_[i].parent) {
    for (std::uint32_t t = states_[i].time; t < until; ++t) path[t] = states_[i].vertex;
    until = states_[i].time;
  }
  return path;
}

}  // namespace split_mapf
