#include "search/eviction_search.h"

#include <algorithm>
#include <utility>

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
  way_left_.ask(*query.distances, query.rows_and_columns);
  reset();
  if (!pushStart()) return answer;
  findArrival(answer, deadline);
  answer.work.tenths += SearchWork::kTenthsAnEviction * queue_.states().size();
  return answer;
}

void EvictionSearch::findArrival(GapAnswer& answer, const Deadline& deadline) {
  for (std::uint64_t turn = 1; hasTurn(); ++turn) {
    if (turn % kPollEvery == 0 && deadline.expired()) {
      answer.interrupted = true;
      return;
    }
    if (isEvictionsTurn()) {
      evictFrom(turn_[evicted_++]);
      continue;
    }
    answer.cut_short = answer.cut_short || expanded_.size() >= query_->hurry.end;
    const std::uint32_t index = expanded_.size() < query_->hurry.end ? queue_.pop() : leaveWeight();
    if (index == kNone) continue;
    if (queue_[index].towards == kArrived) {
      answer.path = queue_.pathTo(index);
      answer.cut_short = false;
      return;
    }
    if (isOutdated(queue_[index])) continue;
    ++answer.work.expansions;
    expand(index);
  }
}

void EvictionSearch::reset() {
  latest_arrival_ = gaps_.latestArrival();
  offered_.reset(latest_arrival_ + 1);
  queue_.clear();
  heap_.clear();
  for (auto& waiting : waiting_) waiting.clear();
  expanded_.clear();
  turn_.clear();
  evicted_ = 0;
  weight_ = 0;
}

bool EvictionSearch::comesLater(const Waiting& a, const Waiting& b) { return a.weight > b.weight; }

bool EvictionSearch::inTime(Vertex v, std::uint32_t t) const {
  const std::uint32_t distance = distanceOf(v);
  return distance <= latest_arrival_ && t <= latest_arrival_ - distance;
}

/// The first visit that ends after step `t`; null when there is none.
const Stay* EvictionSearch::nextVisit(Vertex v, std::uint32_t t) const {
  const std::vector<Stay>& stays = query_->placed->at(v);
  const auto next = std::partition_point(stays.begin(), stays.end(),
                                         [t](const Stay& stay) { return stay.end <= t; });
  return next != stays.end() ? &*next : nullptr;
}

/// Whether it is a gap that was reached earlier, too, for no more.
bool EvictionSearch::isOutdated(const State& state) {
  if (state.time == 0 || !gaps_.reached()(state.vertex, state.time - 1)) return false;
  const ReservationTable& placed = *query_->placed;
  return !placed.isTaken(state.vertex, state.time) && !placed.isTaken(state.vertex, state.time - 1);
}

bool EvictionSearch::pushStart() {
  if (distanceOf(query_->start) == DistanceTable::kUnreachable) return false;
  if (!gaps_.states().empty()) {
    leaveGaps();
    return true;
  }
  std::uint32_t weight = 0;
  for (const Stay& stay : query_->placed->at(query_->start)) {
    if (stay.begin > query_->departure) break;
    if (isFixed(stay)) return false;
    weight += weightOf(stay);
  }
  State start{query_->start, query_->departure, kForever, kNone, kNone};
  if (!inTime(start.vertex, start.time)) return false;
  if (const Stay* const next = nextVisit(start.vertex, start.time)) {
    const bool inside = next->begin <= start.time;
    start.end = inside ? next->end : next->begin;
    if (inside) start.towards = next->next;
  }
  weight_ = kNone;  // nothing is open yet
  push(start, weight);
  weight_ = 0;
  return true;
}

void EvictionSearch::leaveGaps() {
  for (const GapSearch::State& state : gaps_.states()) {
    const std::uint32_t index =
        queue_.add({state.vertex, state.time, state.leave_by, kNone, state.parent});
    if (!gaps_.isOutdated(state)) queue_.open(index, keyOf(index));
  }
  while (!queue_.empty()) {
    expanded_.push_back(queue_.pop());
    arrive(State(queue_[expanded_.back()]));
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
  if (state.towards != kArrived) {
    if (gaps_.reached()(state.vertex, state.time)) return;
    gaps_.reached().mark(state.vertex, state.time, state.end);
  }
  queue_.open(index, keyOf(index));
}

bool EvictionSearch::hasTurn() {
  return !queue_.empty() || evicted_ < turn_.size() || openNextWeight();
}

/// Whether the state from which somebody could be evicted next comes before all that is open.
bool EvictionSearch::isEvictionsTurn() {
  if (evicted_ == turn_.size()) return false;
  return queue_.empty() || keyOf(turn_[evicted_]) < queue_.leastKey();
}

/// What is open counts as expanded, and nobody more of that weight is evicted. @return one that has
/// arrived; kNone: there is none.
std::uint32_t EvictionSearch::leaveWeight() {
  while (!queue_.empty()) {
    const std::uint32_t index = queue_.pop();
    if (queue_[index].towards == kArrived) return index;
    expanded_.push_back(index);
  }
  evicted_ = turn_.size();
  return kNone;
}

/// Whose keys also fall along a path were not expanded in their order.
void EvictionSearch::sortTurn() {
  std::vector<std::pair<std::size_t, std::uint32_t>> keys;
  keys.reserve(turn_.size());
  for (const std::uint32_t index : turn_) keys.emplace_back(keyOf(index), index);
  std::sort(keys.begin(), keys.end());
  for (std::size_t i = 0; i < keys.size(); ++i) turn_[i] = keys[i].second;
}

bool EvictionSearch::openNextWeight() {
  turn_.clear();
  turn_.swap(expanded_);
  if (hurries()) sortTurn();
  evicted_ = 0;
  if (!turn_.empty()) {  // nobody weighs less than 1
    ++weight_;
    openWaiting();
    return true;
  }
  for (; weight_ < kLists; ++weight_) {
    openWaiting();
    if (!queue_.empty()) return true;
  }
  while (queue_.empty() && !heap_.empty()) {
    weight_ = heap_.front().weight;
    openWaiting();
  }
  return !queue_.empty();
}

/// Opens what has waited for the weight whose turn it is.
void EvictionSearch::openWaiting() {
  if (weight_ < kLists) {
    for (const std::uint32_t index : waiting_[weight_]) open(index);
    waiting_[weight_].clear();
  }
  while (!heap_.empty() && heap_.front().weight == weight_) {
    const std::uint32_t index = heap_.front().index;
    std::pop_heap(heap_.begin(), heap_.end(), comesLater);
    heap_.pop_back();
    open(index);
  }
}

/// All that is free of charge; who could be evicted from here has time until the next weight.
void EvictionSearch::expand(std::uint32_t index) {
  const State state = queue_[index];
  expanded_.push_back(index);
  for (const Vertex to : graph_.neighbours(state.vertex)) moveIntoGaps(state, index, to);
  arrive(state);
  if (state.towards != kNone) leaveVisit(state, index);
}

/// All that costs something, from a state that weighs one less than what is open now.
void EvictionSearch::evictFrom(std::uint32_t index) {
  const State state = queue_[index];
  waitIntoVisit(state, index);
  for (const Vertex to : graph_.neighbours(state.vertex)) moveIntoVisits(state, index, to);
}

/// At the goal for good: all who come later are evicted.
void EvictionSearch::arrive(const State& state) {
  if (state.vertex != query_->distances->goal()) return;
  std::uint32_t weight = weight_;
  for (const Stay& stay : query_->placed->at(state.vertex)) {
    if (stay.begin <= state.time) continue;
    if (isFixed(stay)) return;
    weight += weightOf(stay);
  }
  push({state.vertex, state.time, kForever, kArrived, state.parent}, weight);
}

/// Once whom it has evicted would leave: stays alone, or goes the same way.
void EvictionSearch::leaveVisit(const State& state, std::uint32_t index) {
  const std::uint32_t t = state.end;
  const Vertex to = state.towards;
  if (inTime(to, t) && !gaps_.reached()(to, t)) {
    const Stay& visit = *nextVisit(to, t);
    push({to, t, visit.end, visit.next, index}, weight_);
  }
  if (!inTime(state.vertex, t) || query_->placed->isTaken(state.vertex, t)) return;
  if (gaps_.reached()(state.vertex, t)) return;
  const Stay* const next = nextVisit(state.vertex, t);
  push({state.vertex, t, next == nullptr ? kForever : next->begin, kNone, index}, weight_);
}

void EvictionSearch::waitIntoVisit(const State& state, std::uint32_t index) {
  const std::uint32_t t = state.end;
  if (t == kForever || !inTime(state.vertex, t)) return;
  if (gaps_.reached()(state.vertex, t) || offered_(state.vertex, t)) return;
  if (!query_->placed->isTaken(state.vertex, t)) return;
  const Stay& visit = *nextVisit(state.vertex, t);
  offered_.mark(state.vertex, t, visit.end);
  if (isFixed(visit)) return;
  push({state.vertex, t, visit.end, visit.next, index}, weight_ - 1 + weightOf(visit));
}

void EvictionSearch::moveIntoGaps(const State& state, std::uint32_t index, Vertex to) {
  const std::uint32_t distance = distanceOf(to);
  if (distance > latest_arrival_) return;
  const std::uint32_t last = std::min(state.end, latest_arrival_ - distance);
  if (state.time + 1 > last) return;
  const ReservationTable& placed = *query_->placed;
  ReachedSteps& reached = gaps_.reached();
  forEachNewGap(placed, reached, {state.vertex, to, state.end, state.time + 1, last},
                [&](std::uint32_t first) {
                  const std::uint32_t end =
                      reached.markGap(placed, to, first, latest_arrival_ - distance + 1);
                  queue_.push({to, first, end, kNone, index}, keyOf(first, distance));
                });
}

void EvictionSearch::moveIntoVisits(const State& state, std::uint32_t index, Vertex to) {
  const std::uint32_t distance = distanceOf(to);
  if (distance > latest_arrival_) return;
  const std::uint32_t last = std::min(state.end, latest_arrival_ - distance);
  if (state.time + 1 > last) return;
  const ReservationTable& placed = *query_->placed;
  if (last == state.end) evictOncoming(state, index, to);
  const std::uint64_t* const reached = gaps_.reached().row(to);
  const std::uint64_t* offered = nullptr;  // looked up only where somebody could be evicted
  const Stay* visit = nullptr;
  forEachStep(
      state.time + 1, last,
      [&](std::uint32_t word) -> std::uint64_t {
        const std::uint64_t taken = placed.taken(to, word) & ~reached[word];
        if (taken == 0) return 0;
        if (offered == nullptr) offered = offered_.row(to);
        return taken & ~offered[word];
      },
      [&](std::uint32_t t) {
        visit = visit == nullptr ? nextVisit(to, t) : visit + 1;
        while (visit->end <= t) ++visit;
        return enterVisit(state, *visit, {to, t, visit->end, visit->next, index});
      });
}

/// Only at the last step at which a robot can leave somebody may come towards it.
void EvictionSearch::evictOncoming(const State& state, std::uint32_t index, Vertex to) {
  const std::uint32_t t = state.end;
  const ReservationTable& placed = *query_->placed;
  if (!placed.isTaken(to, t - 1) || placed.isTaken(to, t) || gaps_.reached()(to, t)) return;
  const Stay* const met = placed.oncoming(state.vertex, to, t);
  if (met == nullptr || isFixed(*met)) return;
  const Stay* const next = nextVisit(to, t);
  const std::uint32_t end = next == nullptr ? kForever : next->begin;
  push({to, t, end, kNone, index}, weight_ - 1 + weightOf(*met));
}

/// @return whether there is more to enter: nothing after the last step.
bool EvictionSearch::enterVisit(const State& state, const Stay& visit, const State& entered) {
  if (isFixed(visit)) {
    offered_.mark(entered.vertex, entered.time, visit.end);  // nobody ever enters it
    return true;
  }
  std::uint32_t weight = weight_ - 1 + weightOf(visit);
  const Stay* const met = entered.time == state.end
                              ? query_->placed->oncoming(state.vertex, entered.vertex, entered.time)
                              : nullptr;
  if (met != nullptr && isFixed(*met)) return false;
  if (met != nullptr) {
    weight += weightOf(*met);
  } else {
    offered_.mark(entered.vertex, entered.time, visit.end);
  }
  push(entered, weight);
  return met == nullptr;
}

}  // namespace split_mapf
