#include "solver/search/eviction_search.h"

#include <algorithm>

namespace split_mapf {
namespace {

constexpr std::uint64_t kPollEvery = 1024;

}  // namespace

EvictionSearch::EvictionSearch(const Graph& graph)
    : graph_(graph),
      gaps_(graph),
      met_(graph.size(), 0),
      first_span_(graph.size(), 0),
      waiting_(kLists) {}

GapAnswer EvictionSearch::search(const EvictionQuery& query, const Deadline& deadline) {
  GapAnswer answer = gaps_.search(query, deadline);
  if (!answer.path.empty() || answer.interrupted || query.weights == nullptr) return answer;
  query_ = &query;
  reset();
  prepareGoal();
  if (!pushStart()) return answer;
  for (std::uint32_t index = pop(); index != kNone; index = pop()) {
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
    expand(index, false);
  }
  return answer;
}

void EvictionSearch::reset() {
  seen_.clear();
  queue_.clear();
  heap_.clear();
  for (auto& waiting : waiting_) waiting.clear();
  open_weight_ = 0;
  if (++search_number_ == 0) {
    std::fill(met_.begin(), met_.end(), 0);
    search_number_ = 1;
  }
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

void EvictionSearch::prepareGoal() {
  const std::vector<Stay>& stays = query_->placed->at(query_->distances->goal());
  weight_from_visit_.assign(stays.size() + 1, 0);
  for (std::size_t k = stays.size(); k-- > 0;) {
    weight_from_visit_[k] = weight_from_visit_[k + 1] + weightOf(stays[k]);
  }
}

bool EvictionSearch::pushStart() {
  const std::uint32_t distance = (*query_->distances)(query_->start);
  if (distance == DistanceTable::kUnreachable) return false;
  if (!gaps_.states().empty()) {
    leaveGaps();
    return true;
  }
  std::uint32_t weight = 0;
  std::uint32_t span = 0;
  for (const Stay& stay : query_->placed->at(query_->start)) {
    if (stay.begin > query_->departure) break;
    weight += weightOf(stay);
    span += stay.end > query_->departure ? 1 : 2;
  }
  reach(kNone, query_->start, span, query_->departure, weight);
  return true;
}

void EvictionSearch::leaveGaps() {
  const std::vector<GapSearch::State>& reached = gaps_.states();
  const auto span_of = [this](const GapSearch::State& state) {
    const std::vector<Stay>& stays = query_->placed->at(state.vertex);
    const auto next = std::partition_point(stays.begin(), stays.end(), [&state](const Stay& stay) {
      return stay.begin <= state.time;
    });
    return 2 * static_cast<std::uint32_t>(next - stays.begin());
  };
  for (const GapSearch::State& state : reached) {
    queue_.add({state.vertex, span_of(state), state.time, 0, state.parent});
  }
  for (std::uint32_t index = 0; index < reached.size(); ++index) {
    if (!gaps_.isOutdated(reached[index])) expand(index, true);
  }
}

void EvictionSearch::push(const State& state, std::uint32_t estimate) {
  const std::uint32_t index = queue_.add(state);
  if (state.weight == open_weight_) return queue_.open(index, estimate);
  const Waiting waiting{state.weight, estimate, index};
  if (state.weight < kLists) {
    waiting_[state.weight].push_back(waiting);
  } else {
    heap_.push_back(waiting);
    std::push_heap(heap_.begin(), heap_.end(), comesLater);
  }
}

/// The state of the least weight and, among these, the least estimate; kNone when none is left.
std::uint32_t EvictionSearch::pop() {
  if (!queue_.empty() || openNextWeight()) return queue_.pop();
  if (heap_.empty()) return kNone;
  std::pop_heap(heap_.begin(), heap_.end(), comesLater);
  const std::uint32_t index = heap_.back().index;
  heap_.pop_back();
  return index;
}

bool EvictionSearch::openNextWeight() {
  for (; open_weight_ < kLists; ++open_weight_) {
    std::vector<Waiting>& waiting = waiting_[open_weight_];
    if (waiting.empty()) continue;
    for (const Waiting& state : waiting) queue_.open(state.index, state.estimate);
    waiting.clear();
    return true;
  }
  return false;
}

void EvictionSearch::expand(std::uint32_t index, bool only_evicting) {
  const State state = queue_[index];
  if (only_evicting && state.vertex == query_->distances->goal()) arrive(state, index);
  wait(state, index);
  const std::uint32_t leave_by = endOf(state.vertex, state.span);
  for (const Vertex to : graph_.neighbours(state.vertex)) {
    if (only_evicting) {
      moveEvicting(state, index, to, leave_by);
    } else {
      move(state, index, to, leave_by);
    }
  }
}

void EvictionSearch::wait(const State& state, std::uint32_t index) {
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
    enter(state, index, to, 2 * visit + 1, std::max(soonest, gap_end),
          std::min(leave_by, stays[visit].end - 1));
  }
}

/// The moves that a GapSearch leaves out: into visits, and into gaps by a swap.
void EvictionSearch::moveEvicting(const State& state, std::uint32_t index, Vertex to,
                                  std::uint32_t leave_by) {
  const std::uint32_t distance = (*query_->distances)(to);
  if (distance > query_->latest_arrival) return;
  const std::uint32_t last = std::min(leave_by, query_->latest_arrival - distance);
  const std::uint32_t soonest = state.time + 1;
  const std::vector<Stay>& stays = query_->placed->at(to);
  const auto ahead = std::partition_point(
      stays.begin(), stays.end(), [soonest](const Stay& stay) { return stay.end < soonest; });
  for (auto stay = ahead; stay != stays.end() && stay->begin <= last; ++stay) {
    const auto visit = static_cast<std::uint32_t>(stay - stays.begin());
    const std::uint32_t first = std::max(soonest, stay->begin);
    if (first < stay->end) {
      enter(state, index, to, 2 * visit + 1, first, std::min(last, stay->end - 1));
    }
    const bool swaps = stay->end <= last && stay->next == state.vertex;
    if (swaps && stay->end < endOf(to, 2 * visit + 2)) {
      reach(index, to, 2 * visit + 2, stay->end, state.weight + weightOf(*stay));
    }
  }
}

std::uint32_t EvictionSearch::swapWeight(Vertex from, Vertex to, std::uint32_t span,
                                         std::uint32_t time) const {
  if (span < 2) return 0;
  const Stay& before = query_->placed->at(to)[(span - 2) / 2];
  return before.end == time && before.next == from ? weightOf(before) : 0;
}

std::uint32_t EvictionSearch::weightToEnter(const State& state, Vertex to,
                                            std::uint32_t span) const {
  if (!isVisit(span)) return 0;
  const Stay& met = query_->placed->at(to)[span / 2];
  if (isVisit(state.span) && query_->placed->at(state.vertex)[state.span / 2].robot == met.robot) {
    return 0;  // evicted already
  }
  return weightOf(met);
}

void EvictionSearch::enter(const State& state, std::uint32_t index, Vertex to, std::uint32_t span,
                           std::uint32_t first, std::uint32_t last) {
  if (first > last || first > query_->latest_arrival) return;
  const std::uint32_t weight = state.weight + weightToEnter(state, to, span);
  const std::uint32_t extra = swapWeight(state.vertex, to, span, first);
  reach(index, to, span, first, weight + extra);
  // A step later there is no swap any more.
  if (extra > 0 && first < last) reach(index, to, span, first + 1, weight);
}

void EvictionSearch::reach(std::uint32_t parent, Vertex to, std::uint32_t span, std::uint32_t time,
                           std::uint32_t weight) {
  const std::uint32_t distance = (*query_->distances)(to);
  const std::uint32_t estimate = time + distance;
  if (estimate > query_->latest_arrival) return;
  const State reached{to, span, time, weight, parent};
  if (distance == 0) {
    arrive(reached, parent);
    // Once the goal can be held for good at no price there is nothing to go on for.
    if (span == 2 * query_->placed->at(to).size()) return;
  }
  // What the gaps alone reached comes at no weight.
  if (!isVisit(span) && gaps_.reached(to, time)) return;
  Seen& there = seen(to, span);
  if (time >= there.closed_time) return;
  if (time >= there.pushed_time && weight >= there.pushed_weight) return;
  if (there.pushed_weight >= weight) {
    there.pushed_time = time;
    there.pushed_weight = weight;
  }
  push(reached, estimate);
}

/// At the goal, for good.
void EvictionSearch::arrive(const State& state, std::uint32_t parent) {
  const std::uint32_t weight = state.weight + weight_from_visit_[(state.span + 1) / 2];
  push({state.vertex, kNone, state.time, weight, parent}, state.time);
}

}  // namespace split_mapf
