#include "split/intermediate_states.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace split_mapf {
namespace {

// What the parts of a rating weigh when they are added up: a step beyond the shares lengthens the
// whole plan, a detour only one robot's way, a deviation from the target nothing by itself.
constexpr std::uint32_t kExcessCost = 10000;
constexpr std::uint32_t kDetourCost = 100;

}  // namespace

IntermediateStates::IntermediateStates(const Instance& instance)
    : instance_(instance),
      used_(instance.graph().size(), false),
      seen_(instance.graph().size(), 0),
      walked_(instance.graph().size(), 0) {}

std::vector<std::uint32_t> IntermediateStates::longestFirst(const std::vector<Vertex>& from) const {
  std::vector<std::uint32_t> order(instance_.robots());
  std::iota(order.begin(), order.end(), 0U);
  std::vector<std::uint32_t> length(order.size());
  for (const std::uint32_t i : order) length[i] = instance_.distances(i)(from[i]);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return length[a] > length[b]; });
  return order;
}

IntermediateStates::Query IntermediateStates::queryFor(std::uint32_t robot,
                                                       const DistanceTable& to_goal, Vertex from,
                                                       std::uint32_t target, TimeShare share) {
  return {robot, &to_goal, from, to_goal(from), target, share};
}

std::vector<Vertex> IntermediateStates::choose(const std::vector<Vertex>& from,
                                               const std::vector<std::uint32_t>& target,
                                               TimeShare share, RandomEngine& engine,
                                               const Deadline& deadline) {
  std::fill(used_.begin(), used_.end(), false);
  std::vector<Vertex> chosen(from.size(), kNoVertex);
  for (std::uint32_t i = 0; i < from.size(); ++i) {
    if (target[i] != instance_.distances(i)(from[i])) continue;
    chosen[i] = instance_.goal(i);
    used_[chosen[i]] = true;
  }
  for (const std::uint32_t i : longestFirst(from)) {
    if (chosen[i] != kNoVertex) continue;
    if (deadline.expired()) return {};
    const HeldDistances to_goal = instance_.distances(i);
    const Query query = queryFor(i, *to_goal, from[i], target[i], share);
    chosen[i] = chooseOnWay(query, engine);
    if (chosen[i] == kNoVertex) chosen[i] = chooseOne(query, engine);
    used_[chosen[i]] = true;
  }
  return chosen;
}

std::vector<Vertex> IntermediateStates::match(const std::vector<Vertex>& from,
                                              const std::vector<std::uint32_t>& target,
                                              TimeShare share, RandomEngine& engine,
                                              const Deadline& deadline) {
  std::vector<std::vector<Candidate>> candidates(from.size());
  for (std::uint32_t i = 0; i < from.size(); ++i) {
    if (deadline.expired()) return {};
    const HeldDistances to_goal = instance_.distances(i);
    candidates[i] = candidatesOf(queryFor(i, *to_goal, from[i], target[i], share), engine);
  }
  std::vector<Vertex> chosen = assignAtLeastCost(candidates);
  std::fill(used_.begin(), used_.end(), false);
  for (const Vertex v : chosen) {
    if (v != kNoVertex) used_[v] = true;
  }
  for (const std::uint32_t i : longestFirst(from)) {
    if (chosen[i] != kNoVertex) continue;
    if (deadline.expired()) return {};
    const HeldDistances to_goal = instance_.distances(i);
    chosen[i] = chooseOne(queryFor(i, *to_goal, from[i], target[i], share), engine);
    used_[chosen[i]] = true;
  }
  return chosen;
}

Vertex IntermediateStates::chooseOnWay(const Query& query, RandomEngine& engine) {
  if (!ways_) return kNoVertex;
  // Between these two a step adds no excess, or takes away as much as it adds.
  const std::uint32_t rest_fits = query.length - std::min(query.length, query.share.rest);
  const std::uint32_t piece_fits = std::min(query.length, query.share.piece);
  const std::uint32_t steps =
      std::clamp(query.target, std::min(rest_fits, piece_fits), std::max(rest_fits, piece_fits));
  const Vertex v = ways_->after(query.robot, *query.to_goal, query.from, steps, engine);
  return used_[v] ? kNoVertex : v;
}

std::vector<Candidate> IntermediateStates::candidatesOf(const Query& query, RandomEngine& engine) {
  constexpr std::size_t kMostCandidates = 16;
  constexpr std::uint32_t kDetour = 2;
  std::vector<std::pair<Candidate, std::uint64_t>> rated;  // with a random tie-break
  walk(query, kDetour, [&](Vertex v, std::uint32_t walked) {
    const Rating rating = rate(query, v, walked);
    rated.push_back(
        {{v, kExcessCost * rating.excess + kDetourCost * rating.detour + rating.deviation},
         engine()});
  });
  const auto cheaper = [](const auto& a, const auto& b) {
    return a.first.cost != b.first.cost ? a.first.cost < b.first.cost : a.second < b.second;
  };
  const std::size_t kept = std::min(kMostCandidates, rated.size());
  std::partial_sort(rated.begin(), rated.begin() + static_cast<std::ptrdiff_t>(kept), rated.end(),
                    cheaper);
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < kept; ++i) candidates.push_back(rated[i].first);
  return candidates;
}

Vertex IntermediateStates::chooseOne(const Query& query, RandomEngine& engine) {
  best_ = kNoVertex;
  const std::uint32_t total = query.share.piece + query.share.rest;
  for (std::uint32_t detour = 0;; detour = std::max(2 * detour, 1U)) {
    // A longer way cannot exceed the shares by less than this.
    const std::uint32_t least = std::max(query.length + detour, total) - total;
    if (best_ != kNoVertex && best_rating_.excess <= least) return best_;
    searchWithDetour(query, detour, engine);
    // Robots outnumber no component's cells, so a free cell comes once the detour covers it all.
  }
}

void IntermediateStates::searchWithDetour(const Query& query, std::uint32_t detour,
                                          RandomEngine& engine) {
  best_ = kNoVertex;
  walk(query, detour, [&](Vertex v, std::uint32_t walked) {
    if (!used_[v]) consider(query, v, walked, engine);
  });
}

template <typename Visit>
void IntermediateStates::walk(const Query& query, std::uint32_t detour, Visit visit) {
  const DistanceTable& to_goal = *query.to_goal;
  const std::uint32_t deepest = query.share.piece + detour;
  ++search_number_;
  queue_.clear();
  queue_.push_back(query.from);
  seen_[query.from] = search_number_;
  walked_[query.from] = 0;
  for (std::size_t head = 0; head < queue_.size(); ++head) {
    const Vertex v = queue_[head];
    visit(v, walked_[v]);
    if (walked_[v] == deepest) continue;
    for (const Vertex u : instance_.graph().neighbours(v)) {
      if (seen_[u] == search_number_) continue;
      if (walked_[v] + 1 + to_goal(u) > query.length + detour) continue;
      seen_[u] = search_number_;
      walked_[u] = walked_[v] + 1;
      queue_.push_back(u);
    }
  }
}

IntermediateStates::Rating IntermediateStates::rate(const Query& query, Vertex v,
                                                    std::uint32_t walked) {
  const std::uint32_t left = (*query.to_goal)(v);
  return {std::max(walked, query.share.piece) - query.share.piece +
              std::max(left, query.share.rest) - query.share.rest,
          walked + left - query.length,
          std::max(walked, query.target) - std::min(walked, query.target)};
}

void IntermediateStates::consider(const Query& query, Vertex v, std::uint32_t walked,
                                  RandomEngine& engine) {
  const Rating rating = rate(query, v, walked);
  if (best_ == kNoVertex || better(rating, best_rating_)) {
    best_ = v;
    best_rating_ = rating;
    equals_ = 1;
  } else if (!better(best_rating_, rating) && drawBelow(engine, ++equals_) == 0) {
    best_ = v;
  }
}

bool IntermediateStates::better(const Rating& a, const Rating& b) {
  return std::tie(a.excess, a.detour, a.deviation) < std::tie(b.excess, b.detour, b.deviation);
}

}  // namespace split_mapf
