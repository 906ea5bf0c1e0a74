#include "solver/search/eviction_search.h"

#include <algorithm>

namespace split_mapf {
namespace {

constexpr std::uint64_t kPollEvery = 1024;

}  // namespace

EvictionSearch::EvictionSearch(const Graph& graph)
    : graph_(graph), gaps_(graph), offered_(graph.size()), waiting_(kLists) {}

GapAnswer EvictionSearch::search(const EvictionQuery& query, const Deadline& deadline) {
  GapAnswer answer = gaps_.search(query, deadline);
  if (!answer.path.empty() || answer.interrupted || query.weights == nullptr) return answer;
  query_ = &query;
  reset();
  if (!pushStart()) return answer;
  for (std::uint32_t index = pop(); index != kNone; index = pop()) {
    const State& state = queue_[index];
    if (state.robot == kArrived) {
      answer.path = queue_.pathTo(index);
      return answer;
    }
    if (++answer.expansions % kPollEvery == 0 && deadline.expired()) {
      answer.interrupted = true;
      return answer;
    }
    expand(index);
  }
  return answer;
}

void EvictionSearch::reset() {
  latest_arrival_ = gaps_.latestArrival();
  offered_.reset(latest_arrival_ + 1);
  queue_.clear();
  heap_.clear();
  for (auto& waiting : waiting_) waiting.clear();
  weight_ = 0;
}

bool EvictionSearch::comesLater(const Waiting& a, const Waiting& b) { return a.weight > b.weight; }

bool EvictionSearch::inTime(Vertex v, std::uint32_t t) const {
  const std::uint32_t distance = (*query_->distances)(v);
  return distance <= latest_arrival_ && t <= latest_arrival_ - distance;
}

/// The first visit that ends after step `t`; null when there is none.
const Stay* EvictionSearch::nextVisit(Vertex v, std::uint32_t t) const {
  const std::vector<Stay>& stays = query_->placed->at(v);
  const auto next = std::partition_point(stays.begin(), stays.end(),
                                         [t](const Stay& stay) { return stay.end <= t; });
  return next != stays.end() ? &*next : nullptr;
}

bool EvictionSearch::pushStart() {
  if ((*query_->distances)(query_->start) == DistanceTable::kUnreachable) return false;
  if (!gaps_.states().empty()) {
    leaveGaps();
    return true;
  }
  std::uint32_t weight = 0;
  for (const Stay& stay : query_->placed->at(query_->start)) {
    if (stay.begin <= query_->departure) weight += weightOf(stay);
  }
  State start{query_->start, query_->departure, kForever, kNone, kNone};
  if (!inTime(start.vertex, start.time)) return false;
  if (const Stay* const next = nextVisit(start.vertex, start.time)) {
    const bool inside = next->begin <= start.time;
    start.end = inside ? next->end : next->begin;
    if (inside) start.robot = next->robot;
  }
  weight_ = kNone;  // nothing is open yet
  push(start, weight);
  weight_ = 0;
  return true;
}

void EvictionSearch::leaveGaps() {
  const std::vector<GapSearch::State>& reached = gaps_.states();
  for (const GapSearch::State& state : reached) {
    queue_.add({state.vertex, state.time, state.leave_by, kNone, state.parent});
  }
  for (std::uint32_t index = 0; index < reached.size(); ++index) {
    if (!gaps_.isOutdated(reached[index])) evictFrom(State(queue_[index]), index);
  }
}

void EvictionSearch::push(const State& state, std::uint32_t weight) {
  const std::uint32_t index = queue_.add(state);
  if (weight == weight_) return open(index);
  if (weight < kLists) return waiting_[weight].push_back(index);
  heap_.push_back({weight, index});
  std::push_heap(heap_.begin(), heap_.end(), comesLater);
}

/// Opens a state whose weight has its turn, unless what is open reached it already.
void EvictionSearch::open(std::uint32_t index) {
  const State& state = queue_[index];
  if (state.robot != kArrived) {
    if (gaps_.reached()(state.vertex, state.time)) return;
    gaps_.reached().mark(state.vertex, state.time, state.end);
  }
  queue_.open(index, state.time + (*query_->distances)(state.vertex));
}

std::uint32_t EvictionSearch::pop() {
  return !queue_.empty() || openNextWeight() ? queue_.pop() : kNone;
}

bool EvictionSearch::openNextWeight() {
  for (; weight_ < kLists; ++weight_) {
    std::vector<std::uint32_t> turn;
    turn.swap(waiting_[weight_]);
    for (const std::uint32_t index : turn) open(index);
    turn.clear();
    turn.swap(waiting_[weight_]);  // its memory is kept
    if (!queue_.empty()) return true;
  }
  while (queue_.empty() && !heap_.empty()) {
    weight_ = heap_.front().weight;
    while (!heap_.empty() && heap_.front().weight == weight_) {
      const std::uint32_t index = heap_.front().index;
      std::pop_heap(heap_.begin(), heap_.end(), comesLater);
      heap_.pop_back();
      open(index);
    }
  }
  return !queue_.empty();
}

void EvictionSearch::expand(std::uint32_t index) {
  const State state = queue_[index];
  for (const Vertex to : graph_.neighbours(state.vertex)) moveIntoGaps(state, index, to);
  evictFrom(state, index);
}

/// All that a GapSearch leaves out.
void EvictionSearch::evictFrom(const State& state, std::uint32_t index) {
  arrive(state, index);
  wait(state, index);
  for (const Vertex to : graph_.neighbours(state.vertex)) moveIntoVisits(state, index, to);
}

/// At the goal for good: all who come later are evicted.
void EvictionSearch::arrive(const State& state, std::uint32_t index) {
  if (state.vertex != query_->distances->goal()) return;
  std::uint32_t weight = weight_;
  for (const Stay& stay : query_->placed->at(state.vertex)) {
    if (stay.begin > state.time) weight += weightOf(stay);
  }
  push({state.vertex, state.time, kForever, kArrived, queue_[index].parent}, weight);
}

void EvictionSearch::wait(const State& state, std::uint32_t index) {
  if (state.end == kForever || !inTime(state.vertex, state.end)) return;
  if (gaps_.reached()(state.vertex, state.end)) return;
  const Stay* const next = nextVisit(state.vertex, state.end);
  if (next == nullptr || next->begin > state.end) {
    const std::uint32_t end = next == nullptr ? kForever : next->begin;
    push({state.vertex, state.end, end, kNone, index}, weight_);
  } else if (!offered_(state.vertex, state.end)) {
    offered_.mark(state.vertex, state.end, next->end);
    push({state.vertex, state.end, next->end, next->robot, index}, weight_ + weightOf(*next));
  }
}

void EvictionSearch::moveIntoGaps(const State& state, std::uint32_t index, Vertex to) {
  if (!inTime(to, state.time + 1)) return;
  const std::uint32_t distance = (*query_->distances)(to);
  const std::uint32_t last = std::min(state.end, latest_arrival_ - distance);
  const ReservationTable& placed = *query_->placed;
  ReachedSteps& reached = gaps_.reached();
  forEachNewGap(placed, reached, {state.vertex, to, state.end, state.time + 1, last},
                [&](std::uint32_t first) {
                  const std::uint32_t end =
                      reached.markGap(placed, to, first, latest_arrival_ - distance + 1);
                  queue_.push({to, first, end, kNone, index}, first + distance);
                });
}

void EvictionSearch::moveIntoVisits(const State& state, std::uint32_t index, Vertex to) {
  if (!inTime(to, state.time + 1)) return;
  const std::uint32_t distance = (*query_->distances)(to);
  const std::uint32_t last = std::min(state.end, latest_arrival_ - distance);
  const ReservationTable& placed = *query_->placed;
  if (last == state.end) moveAtLast(state, index, to);
  const std::uint64_t* const reached = gaps_.reached().row(to);
  const std::uint64_t* const offered = offered_.row(to);
  std::uint32_t from = state.time + 1;  // of what is left; each visit counts once
  const auto left_of = [&from](std::uint32_t word) {
    if (64 * word + 63 < from) return std::uint64_t{0};
    return 64 * word >= from ? ReachedSteps::kAllSteps : ReachedSteps::kAllSteps << (from % 64);
  };
  forEachStep(
      from, last,
      [&](std::uint32_t word) {
        return placed.taken(to, word) & ~reached[word] & ~offered[word] & left_of(word);
      },
      [&](std::uint32_t t) {
        const Stay& visit = *nextVisit(to, t);
        enterVisit(state, visit, {to, t, visit.end, visit.robot, index});
        from = visit.end;
        return from <= last;
      });
}

/// The last step at which a robot can leave is the only one at which somebody may come towards it,
/// and the only one at which whom it has evicted may go the same way: that is free of charge.
void EvictionSearch::moveAtLast(const State& state, std::uint32_t index, Vertex to) {
  const std::uint32_t t = state.end;
  if (gaps_.reached()(to, t)) return;
  const Stay* const next = nextVisit(to, t);
  if (next != nullptr && next->begin <= t) {
    if (next->robot == state.robot) push({to, t, next->end, next->robot, index}, weight_);
    return;
  }
  const Stay* const met = query_->placed->oncoming(state.vertex, to, t);
  if (met == nullptr) return;
  const std::uint32_t end = next == nullptr ? kForever : next->begin;
  push({to, t, end, kNone, index}, weight_ + weightOf(*met));
}

void EvictionSearch::enterVisit(const State& state, const Stay& visit, const State& entered) {
  std::uint32_t weight = weight_ + weightOf(visit);
  const Stay* const met = entered.time == state.end
                              ? query_->placed->oncoming(state.vertex, entered.vertex, entered.time)
                              : nullptr;
  if (met != nullptr) {
    weight += weightOf(*met);
  } else {
    offered_.mark(entered.vertex, entered.time, visit.end);
  }
  push(entered, weight);
}

}  // namespace split_mapf
