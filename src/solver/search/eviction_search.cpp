#include "solver/search/eviction_search.h"

#include <algorithm>

namespace split_mapf {
namespace {

constexpr std::uint64_t kPollEvery = 1024;

}  // namespace

EvictionSearch::EvictionSearch(const Graph& graph)
    : graph_(graph), met_(graph.size(), 0), first_span_(graph.size(), 0) {}

EvictionAnswer EvictionSearch::search(const EvictionQuery& query, const Deadline& deadline) {
  query_ = &query;
  EvictionAnswer answer;
  reset();
  if (!prepareGoal() || !pushStart()) return answer;
  while (!queue_.empty() || !heap_.empty()) {
    const std::uint32_t index = pop();
    const State state = queue_[index];
    if (state.span == kNone) {
      answer.path = queue_.pathTo(index);
      return answer;
    }
    Seen& span = seen(state.vertex, state.span);
    if (state.time >= span.closed_time) continue;
    span.closed_time = state.time;
    if (++answer.expansions % kPollEvery == 0 && deadline.expired()) {
      answer.interrupted = true;
      return answer;
    }
    expand(index);
  }
  return answer;
}

void EvictionSearch::reset() {
  queue_.clear();
  seen_.clear();
  heap_.clear();
  if (++search_number_ == 0) {
    std::fill(met_.begin(), met_.end(), 0);
    search_number_ = 1;
  }
}

std::uint32_t EvictionSearch::beginOf(Vertex v, std::uint32_t span) const {
  const std::vector<Stay>& stays = query_->placed->at(v);
  if (isVisit(span)) return stays[span / 2].begin;
  return span == 0 ? 0 : stays[span / 2 - 1].end;
}

std::uint32_t EvictionSearch::endOf(Vertex v, std::uint32_t span) const {
  const std::vector<Stay>& stays = query_->placed->at(v);
  if (isVisit(span)) return stays[span / 2].end;
  return span / 2 == stays.size() ? kForever : stays[span / 2].begin;
}

bool EvictionSearch::comesLater(const Waiting& a, const Waiting& b) {
  if (a.weight != b.weight) return a.weight > b.weight;
  if (a.estimate != b.estimate) return a.estimate > b.estimate;
  return a.index < b.index;
}

EvictionSearch::Seen& EvictionSearch::seen(Vertex v, std::uint32_t span) {
  if (met_[v] != search_number_) {
    met_[v] = search_number_;
    first_span_[v] = static_cast<std::uint32_t>(seen_.size());
    seen_.resize(seen_.size() + 2 * query_->placed->at(v).size() + 1);
  }
  return seen_[first_span_[v] + span];
}

bool EvictionSearch::prepareGoal() {
  const std::vector<Stay>& stays = query_->placed->at(query_->distances->goal());
  earliest_hold_ = 0;
  if (query_->weights == nullptr) {
    if (!stays.empty()) earliest_hold_ = stays.back().end;
    return earliest_hold_ < kForever;
  }
  weight_from_visit_.assign(stays.size() + 1, 0);
  for (std::size_t k = stays.size(); k-- > 0;) {
    weight_from_visit_[k] = weight_from_visit_[k + 1] + weightOf(stays[k]);
  }
  return true;
}

bool EvictionSearch::pushStart() {
  const std::uint32_t distance = (*query_->distances)(query_->start);
  if (distance == DistanceTable::kUnreachable) return false;
  first_estimate_ = std::max(query_->departure + distance, earliest_hold_);
  if (first_estimate_ > query_->latest_arrival) return false;
  std::uint32_t weight = 0;
  std::uint32_t span = 0;
  for (const Stay& stay : query_->placed->at(query_->start)) {
    if (stay.begin > query_->departure) break;
    if (query_->weights == nullptr) return false;
    weight += weightOf(stay);
    span += stay.end > query_->departure ? 1 : 2;
  }
  reach(kNone, query_->start, span, query_->departure, weight);
  return true;
}

void EvictionSearch::push(const State& state, std::uint32_t estimate) {
  if (state.weight == 0) return queue_.push(state, estimate - first_estimate_);
  heap_.push_back({state.weight, estimate, queue_.add(state)});
  std::push_heap(heap_.begin(), heap_.end(), comesLater);
}

std::uint32_t EvictionSearch::pop() {
  if (!queue_.empty()) return queue_.pop();
  std::pop_heap(heap_.begin(), heap_.end(), comesLater);
  const std::uint32_t index = heap_.back().index;
  heap_.pop_back();
  return index;
}

void EvictionSearch::expand(std::uint32_t index) {
  const State state = queue_[index];
  wait(state, index);
  const std::uint32_t leave_by = endOf(state.vertex, state.span);
  for (const Vertex to : graph_.neighbours(state.vertex)) move(state, index, to, leave_by);
}

void EvictionSearch::wait(const State& state, std::uint32_t index) {
  // Where nobody may be evicted the visit behind a gap ends it.
  if (query_->weights == nullptr) return;
  const std::uint32_t end = endOf(state.vertex, state.span);
  if (end == kForever) return;
  std::uint32_t next = state.span + 1;
  if (!isVisit(next) && endOf(state.vertex, next) == end) ++next;  // an empty gap
  reach(index, state.vertex, next, end, state.weight + weightToEnter(state, state.vertex, next));
}

void EvictionSearch::move(const State& state, std::uint32_t index, Vertex to,
                          std::uint32_t leave_by) {
  const std::vector<Stay>& stays = query_->placed->at(to);
  const auto visits = static_cast<std::uint32_t>(stays.size());
  const std::uint32_t soonest = state.time + 1;
  const auto ahead = std::partition_point(
      stays.begin(), stays.end(), [soonest](const Stay& stay) { return stay.end <= soonest; });
  auto visit = static_cast<std::uint32_t>(ahead - stays.begin());
  for (;; ++visit) {
    const std::uint32_t gap_begin = visit == 0 ? 0 : stays[visit - 1].end;
    if (gap_begin > leave_by) return;
    const std::uint32_t gap_end = visit == visits ? kForever : stays[visit].begin;
    const std::uint32_t first = std::max(soonest, gap_begin);
    if (first < gap_end) enter(state, index, to, 2 * visit, first, std::min(leave_by, gap_end - 1));
    if (visit == visits || gap_end > leave_by) return;
    if (query_->weights == nullptr) continue;
    enter(state, index, to, 2 * visit + 1, std::max(soonest, gap_end),
          std::min(leave_by, stays[visit].end - 1));
  }
}

std::uint32_t EvictionSearch::swapWeight(Vertex from, Vertex to, std::uint32_t span,
                                         std::uint32_t time, bool& swaps) const {
  swaps = false;
  if (span < 2) return 0;
  const Stay& before = query_->placed->at(to)[(span - 2) / 2];
  if (before.end != time || before.next != from) return 0;
  swaps = true;
  return query_->weights == nullptr ? 0 : weightOf(before);
}

std::uint32_t EvictionSearch::weightToEnter(const State& state, Vertex to,
                                            std::uint32_t span) const {
  if (!isVisit(span)) return 0;
  const Stay& met = query_->placed->at(to)[span / 2];
  if (state.span != kNone && isVisit(state.span) &&
      query_->placed->at(state.vertex)[state.span / 2].robot == met.robot) {
    return 0;  // evicted already
  }
  return weightOf(met);
}

void EvictionSearch::enter(const State& state, std::uint32_t index, Vertex to, std::uint32_t span,
                           std::uint32_t first, std::uint32_t last) {
  if (first > last || first > query_->latest_arrival) return;
  const std::uint32_t weight = state.weight + (isVisit(span) ? weightToEnter(state, to, span) : 0);
  bool swaps = false;
  const std::uint32_t extra = swapWeight(state.vertex, to, span, first, swaps);
  if (!swaps) return reach(index, to, span, first, weight);
  if (query_->weights != nullptr) reach(index, to, span, first, weight + extra);
  // A step later there is no swap any more.
  if (first < last) reach(index, to, span, first + 1, weight);
}

void EvictionSearch::reach(std::uint32_t parent, Vertex to, std::uint32_t span, std::uint32_t time,
                           std::uint32_t weight) {
  const std::uint32_t distance = (*query_->distances)(to);
  const std::uint32_t estimate = std::max(time + distance, earliest_hold_);
  if (estimate > query_->latest_arrival) return;
  const State reached{to, span, time, weight, parent, kNone};
  if (distance == 0) {
    State arrived = reached;
    arrived.span = kNone;
    const bool last = span == 2 * query_->placed->at(to).size();
    if (query_->weights != nullptr) arrived.weight += weight_from_visit_[(span + 1) / 2];
    if (query_->weights != nullptr || last) push(arrived, estimate);
    // Once the goal can be held for good at no price there is nothing to go on for.
    if (last) return;
  }
  Seen& there = seen(to, span);
  if (time >= there.closed_time) return;
  if (time >= there.pushed_time && weight >= there.pushed_weight) return;
  if (there.pushed_weight >= weight) {
    there.pushed_time = time;
    there.pushed_weight = weight;
  }
  push(reached, estimate);
}

std::vector<std::uint32_t> robotsInTheWay(const PathTable& placed, const Path& path) {
  std::vector<std::uint32_t> robots;
  Vertex before = kNoVertex;
  forEachStay(path, [&](Vertex v, std::uint32_t begin, std::uint32_t end, Vertex) {
    for (const Stay& stay : placed.at(v)) {
      if (stay.begin >= end) break;
      const bool meets = stay.end > begin;
      const bool swaps = stay.end == begin && before != kNoVertex && stay.next == before;
      if (meets || swaps) robots.push_back(stay.robot);
    }
    before = v;
  });
  std::sort(robots.begin(), robots.end());
  robots.erase(std::unique(robots.begin(), robots.end()), robots.end());
  return robots;
}

}  // namespace split_mapf
