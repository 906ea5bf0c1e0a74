#include "split/intermediate_states.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace split_mapf {

IntermediateStates::IntermediateStates(const Instance& instance)
    : instance_(instance),
      used_(instance.graph().size(), false),
      seen_(instance.graph().size(), 0),
      walked_(instance.graph().size(), 0) {}

std::vector<Vertex> IntermediateStates::choose(const std::vector<Vertex>& from,
                                               const std::vector<std::uint32_t>& target,
                                               TimeShare share, RandomEngine& engine,
                                               const Deadline& deadline) {
  const std::uint32_t robots = instance_.robots();
  std::vector<std::uint32_t> length(robots);
  for (std::uint32_t i = 0; i < robots; ++i) length[i] = instance_.distances(i)(from[i]);
  std::vector<std::uint32_t> order(robots);
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return length[a] > length[b]; });
  std::fill(used_.begin(), used_.end(), false);
  std::vector<Vertex> chosen(robots, kNoVertex);
  for (const std::uint32_t i : order) {
    if (deadline.expired()) return {};
    chosen[i] = chooseOne({i, from[i], length[i], target[i], share}, engine);
    used_[chosen[i]] = true;
  }
  return chosen;
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
  const DistanceTable& to_goal = instance_.distances(query.robot);
  const std::uint32_t deepest = query.share.piece + detour;
  best_ = kNoVertex;
  ++search_number_;
  queue_.clear();
  queue_.push_back(query.from);
  seen_[query.from] = search_number_;
  walked_[query.from] = 0;
  for (std::size_t head = 0; head < queue_.size(); ++head) {
    const Vertex v = queue_[head];
    if (!used_[v]) consider(query, v, walked_[v], engine);
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

void IntermediateStates::consider(const Query& query, Vertex v, std::uint32_t walked,
                                  RandomEngine& engine) {
  const std::uint32_t left = instance_.distances(query.robot)(v);
  const Rating rating{std::max(walked, query.share.piece) - query.share.piece +
                          std::max(left, query.share.rest) - query.share.rest,
                      walked + left - query.length,
                      std::max(walked, query.target) - std::min(walked, query.target)};
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
