#include "solver/search/gap_search.h"

#include <algorithm>

namespace split_mapf {
namespace {

constexpr std::uint64_t kPollEvery = 1024;
constexpr std::uint64_t kAllSteps = ~std::uint64_t{0};

/// Number of the lowest bit set. @pre bits != 0.
std::uint32_t lowestBit(std::uint64_t bits) {
  return static_cast<std::uint32_t>(__builtin_ctzll(bits));
}

}  // namespace

GapSearch::GapSearch(const Graph& graph) : graph_(graph), met_(graph.size()) {}

void GapSearch::reset() {
  queue_.clear();
  reached_.clear();
  arrived_ = kNoState;
  if (++search_number_ == 0) {
    std::fill(met_.begin(), met_.end(), Met());
    search_number_ = 1;
  }
}

inline std::uint64_t* GapSearch::rowOf(Vertex v) {
  Met& met = met_[v];
  if (met.search != search_number_) meet(met);
  return reached_.data() + met.row;
}

void GapSearch::meet(Met& met) {
  met.search = search_number_;
  met.row = static_cast<std::uint32_t>(reached_.size());
  reached_.resize(reached_.size() + words_, 0);
}

/// Marks the steps from `from` to the end of the gap, to `to` at the latest; returns the step at
/// which somebody comes, kForever when nobody does until `to`.
inline std::uint32_t GapSearch::reachGap(Vertex v, std::uint32_t from, std::uint32_t to) {
  std::uint64_t* const row = rowOf(v);
  std::uint64_t steps = kAllSteps << (from % 64);
  for (std::uint32_t word = from / 64; word <= to / 64; ++word) {
    const std::uint64_t taken = query_->placed->taken(v, word) & steps;
    if (taken != 0) {
      row[word] |= steps & ((taken & (0 - taken)) - 1);
      return 64 * word + lowestBit(taken);
    }
    row[word] |= steps;
    steps = kAllSteps;
  }
  return kForever;
}

inline void GapSearch::push(std::uint32_t parent, Vertex v, std::uint32_t time,
                            std::uint32_t distance) {
  const std::uint32_t leave_by = reachGap(v, time, latest_arrival_ - distance + 1);
  // Not max(estimate, earliest_hold_): among equals the order in time would be lost, and gaps be
  // reached earlier again and again.
  const std::uint32_t estimate = time + distance;
  queue_.push({v, time, leave_by, parent}, estimate - first_estimate_);
  const bool holds = distance == 0 && time >= earliest_hold_;
  if (holds && time <= std::max(estimate_, earliest_hold_)) {
    arrived_ = static_cast<std::uint32_t>(queue_.states().size() - 1);
  }
}

inline bool GapSearch::swaps(const State& state, Vertex to, std::uint32_t t) const {
  // Somebody comes from there just as this robot leaves.
  if (t != state.leave_by || !query_->placed->isTaken(to, t - 1)) return false;
  const std::vector<Stay>& stays = query_->placed->at(to);
  const auto before = std::partition_point(stays.begin(), stays.end(),
                                           [t](const Stay& stay) { return stay.end < t; });
  return before != stays.end() && before->end == t && before->next == state.vertex;
}

inline void GapSearch::move(const State& state, std::uint32_t index, Vertex to) {
  const std::uint32_t distance = distanceOf(to);
  if (distance > latest_arrival_) return;
  const std::uint32_t soonest = state.time + 1;
  const std::uint32_t last = std::min(state.leave_by, latest_arrival_ - distance);
  if (soonest > last) return;
  const std::uint64_t* const row = rowOf(to);
  std::uint64_t steps = kAllSteps << (soonest % 64);
  for (std::uint32_t word = soonest / 64; word <= last / 64; ++word) {
    if (word == last / 64) steps &= kAllSteps >> (63 - last % 64);
    const std::uint64_t free = steps & ~query_->placed->taken(to, word);
    for (std::uint64_t open = free & ~row[word]; open != 0; open &= ~row[word]) {
      const std::uint32_t first = 64 * word + lowestBit(open);
      if (swaps(state, to, first)) break;  // that is the last step
      push(index, to, first, distance);
    }
    steps = kAllSteps;
  }
}

void GapSearch::expand(std::uint32_t index) {
  const State state = queue_[index];
  estimate_ = state.time + distanceOf(state.vertex);
  for (const Vertex to : graph_.neighbours(state.vertex)) move(state, index, to);
}

bool GapSearch::pushStart() {
  const std::vector<Stay>& at_goal = query_->placed->at(query_->distances->goal());
  earliest_hold_ = at_goal.empty() ? 0 : at_goal.back().end;
  const std::uint32_t distance = (*query_->distances)(query_->start);
  if (distance == DistanceTable::kUnreachable || earliest_hold_ == kForever) return false;
  first_estimate_ = estimate_ = query_->departure + distance;
  if (std::max(first_estimate_, earliest_hold_) > query_->latest_arrival) return false;
  const std::vector<Stay>& at_start = query_->placed->at(query_->start);
  if (!at_start.empty() && at_start.front().begin <= query_->departure) return false;
  // Once nobody moves any more the way home takes a step a vertex at most.
  const std::uint64_t longest =
      std::uint64_t{query_->placed->lastChange()} + query_->departure + graph_.size();
  latest_arrival_ =
      static_cast<std::uint32_t>(std::min<std::uint64_t>(query_->latest_arrival, longest));
  words_ = (latest_arrival_ + 1) / 64 + 1;
  push(kNoState, query_->start, query_->departure, distance);
  return true;
}

GapAnswer GapSearch::search(const GapQuery& query, const Deadline& deadline) {
  query_ = &query;
  narrow_ = query.distances->narrowEntries();
  GapAnswer answer;
  reset();
  if (!pushStart()) return answer;
  const Vertex goal = query.distances->goal();
  while (arrived_ == kNoState && !queue_.empty()) {
    const std::uint32_t index = queue_.pop();
    const State& state = queue_[index];
    if (isOutdated(state)) continue;
    if (state.vertex == goal && state.time >= earliest_hold_) {
      arrived_ = index;
      break;
    }
    if (++answer.expansions % kPollEvery == 0 && deadline.expired()) {
      answer.interrupted = true;
      return answer;
    }
    expand(index);
  }
  if (arrived_ != kNoState) answer.path = queue_.pathTo(arrived_);
  return answer;
}

}  // namespace split_mapf
