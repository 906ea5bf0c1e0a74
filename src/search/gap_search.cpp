#include "search/gap_search.h"

#include <algorithm>

namespace split_mapf {
namespace {

constexpr std::uint64_t kPollEvery = 1024;

}  // namespace

GapSearch::GapSearch(const Graph& graph) : graph_(graph), reached_(graph.size()) {}

inline void GapSearch::push(std::uint32_t parent, Vertex v, std::uint32_t time,
                            std::uint32_t distance) {
  // The step at which it is under way is its own.
  const std::uint32_t own = parent == kNoState && query_->under_way ? 1 : 0;
  const std::uint32_t leave_by =
      reached_.markGap(*query_->placed, v, time + own, latest_arrival_ - distance + 1);
  // Not max(estimate, earliest_hold_): among equals the order in time would be lost, and gaps be
  // reached earlier again and again.
  const std::uint32_t estimate = time + distance;
  queue_.push({v, time, leave_by, parent}, keyOf(estimate, distance));
  const bool holds = distance == 0 && time >= earliest_hold_;
  const bool is_first = time <= std::max(estimate_, earliest_hold_);
  if (holds && (is_first || steps_a_delay_ > 0)) {
    arrived_ = static_cast<std::uint32_t>(queue_.states().size() - 1);
  }
}

inline void GapSearch::move(const State& state, std::uint32_t index, Vertex to) {
  const std::uint32_t distance = distanceOf(to);
  if (distance > latest_arrival_) return;
  const std::uint32_t soonest = state.time + 1;
  const std::uint32_t last = std::min(state.leave_by, latest_arrival_ - distance);
  if (soonest > last) return;
  forEachNewGap(*query_->placed, reached_, {state.vertex, to, state.leave_by, soonest, last},
                [&](std::uint32_t first) { push(index, to, first, distance); });
}

void GapSearch::expand(std::uint32_t index) {
  const State state = queue_[index];
  estimate_ = state.time + distanceOf(state.vertex);
  const auto neighbours = graph_.neighbours(state.vertex);
  looks_ += neighbours.size();
  const std::uint32_t word = (state.time + 1) / 64;
  for (const Vertex to : neighbours) query_->placed->prefetch(to, word);
  for (const Vertex to : neighbours) move(state, index, to);
}

bool GapSearch::isStartFree() const {
  const std::vector<Stay>& at_start = query_->placed->at(query_->start);
  return query_->under_way || at_start.empty() || at_start.front().begin > query_->departure;
}

bool GapSearch::begin() {
  queue_.clear();
  arrived_ = kNoState;
  steps_a_delay_ = 0;
  // Once nobody moves any more the way home takes a step a vertex at most.
  const std::uint64_t longest =
      std::uint64_t{query_->placed->lastChange()} + query_->departure + graph_.size();
  latest_arrival_ =
      static_cast<std::uint32_t>(std::min<std::uint64_t>(query_->latest_arrival, longest));
  reached_.reset(latest_arrival_ + 1);
  const std::vector<Stay>& at_goal = query_->placed->at(query_->distances->goal());
  earliest_hold_ = at_goal.empty() ? 0 : at_goal.back().end;
  // Its own visit keeps nobody from staying on.
  const bool at_home = query_->under_way && query_->start == query_->distances->goal();
  const std::uint32_t own_end = query_->departure + 1 + query_->placed->headway();
  if (at_home && earliest_hold_ == own_end) earliest_hold_ = query_->departure;
  const std::uint32_t distance = distanceOf(query_->start);
  if (distance == DistanceTable::kUnreachable || earliest_hold_ == kForever) return false;
  first_estimate_ = estimate_ = query_->departure + distance;
  if (std::max(first_estimate_, earliest_hold_) > query_->latest_arrival) return false;
  if (!isStartFree()) return false;
  push(kNoState, query_->start, query_->departure, distance);
  return true;
}

/// Puts what is open into the new order; what came last stays first among equals.
void GapSearch::hurry(std::uint32_t steps_a_delay) {
  steps_a_delay_ = steps_a_delay;
  std::vector<std::uint32_t> open;
  while (!queue_.empty()) open.push_back(queue_.pop());
  for (auto index = open.rbegin(); index != open.rend(); ++index) {
    const State& state = queue_[*index];
    const std::uint32_t distance = distanceOf(state.vertex);
    queue_.open(*index, keyOf(state.time + distance, distance));
  }
}

void GapSearch::findArrival(GapAnswer& answer, const Deadline& deadline) {
  const Vertex goal = query_->distances->goal();
  std::uint64_t& expansions = answer.work.expansions;
  while (arrived_ == kNoState && !queue_.empty()) {
    if (expansions == query_->hurry.begin && steps_a_delay_ == 0) hurry(Hurry::kStepsADelay);
    if (expansions == query_->hurry.greedy && steps_a_delay_ != Hurry::kGreedyStepsADelay) {
      hurry(Hurry::kGreedyStepsADelay);
    }
    const std::uint32_t index = queue_.pop();
    const State& state = queue_[index];
    if (isOutdated(state)) continue;
    if (state.vertex == goal && state.time >= earliest_hold_) {
      arrived_ = index;
      break;
    }
    if (expansions == query_->hurry.end) {
      answer.cut_short = true;
      return;
    }
    if (++expansions % kPollEvery == 0 && deadline.expired()) {
      answer.interrupted = true;
      return;
    }
    expand(index);
  }
}

GapAnswer GapSearch::search(const GapQuery& query, const Deadline& deadline) {
  query_ = &query;
  way_left_.ask(*query.distances, query.rows_and_columns);
  looks_ = 0;
  GapAnswer answer;
  if (!begin()) return answer;
  findArrival(answer, deadline);
  answer.work.tenths =
      SearchWork::kTenthsALook * looks_ + SearchWork::kTenthsAPlace * queue_.states().size();
  if (arrived_ != kNoState) answer.path = queue_.pathTo(arrived_);
  return answer;
}

}  // namespace split_mapf
