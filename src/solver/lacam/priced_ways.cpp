#include "solver/lacam/priced_ways.h"

#include <algorithm>

namespace split_mapf {
namespace {

// Prices in tenths of a step. Both spread robots: without them they come home a fifth later.
constexpr std::uint32_t kOncoming = 4;
constexpr std::uint32_t kCrowded = 2;
// No way is as dear, so that values take 16 bits.
constexpr std::uint32_t kMostValue = 60000;
constexpr std::uint32_t kMostPrice = 8000;
// Ways from beside the guide are known where they cost so little more.
constexpr std::uint32_t kBeside = 4 * PricedSearch::kStep;

}  // namespace

void PricedWays::clear() {
  page_of_ = {};
  values_ = {};
}

void PricedWays::take(const std::vector<std::uint16_t>& values, const std::vector<Vertex>& known) {
  page_of_.assign(values.size() / kPageSize + 1, 0);
  std::uint32_t pages = 0;
  for (const Vertex v : known) {
    std::uint32_t& page = page_of_[v / kPageSize];
    if (page == 0) page = ++pages;
  }
  values_.assign((pages + std::size_t{1}) * kPageSize, kUnknown);
  values_.shrink_to_fit();
  for (const Vertex v : known) values_[placeOf(v)] = values[v];
}

PricedSearch::PricedSearch(const Instance& instance, const RobotDistances& distances,
                           const HomePasses& passes, const Traffic& traffic, std::uint32_t margin)
    : instance_(instance),
      distances_(distances),
      passes_(passes),
      traffic_(traffic),
      margin_(margin),
      is_grid_(instance.grid().hasUnitMoves()),
      values_(instance.graph().size(), PricedWays::kUnknown),
      towards_(instance.graph().size(), kNoVertex) {}

/// Steps from the robot, at least.
std::uint32_t PricedSearch::estimate(Vertex v) const {
  if (!is_grid_) return 0;
  return rowsAndColumns(instance_.grid().cellOf(v), instance_.grid().cellOf(at_));
}

void PricedSearch::reset() {
  for (const Vertex v : known_) values_[v] = PricedWays::kUnknown;
  known_.clear();
  for (std::size_t key = 0; key < buckets_.size() && key <= last_bucket_; ++key) {
    buckets_[key].clear();
  }
  last_bucket_ = 0;
  expansions_ = 0;
}

void PricedSearch::find(std::uint32_t robot, Vertex at, std::uint32_t now) {
  reset();
  robot_ = robot;
  at_ = at;
  now_ = now;
  shortest_ = distances_(robot, at);
  const Vertex goal = instance_.goal(robot);
  base_ = estimate(goal) * kStep;
  push(goal, 0, goal);
  std::size_t last = kMostValue;
  for (std::size_t key = 0; key < buckets_.size() && key <= last; ++key) {
    for (std::size_t n = 0; n < buckets_[key].size(); ++n) {
      const Vertex v = buckets_[key][n];
      if (values_[v] + estimate(v) * kStep != key + base_) continue;  // it was found again, cheaper
      if (v == at_) last = std::min<std::size_t>(last, key + kBeside);
      expand(v);
    }
  }
  trace();
}

void PricedSearch::push(Vertex v, std::uint32_t value, Vertex towards) {
  if (values_[v] == PricedWays::kUnknown) known_.push_back(v);
  values_[v] = static_cast<std::uint16_t>(value);
  towards_[v] = towards;
  const std::size_t key = value + estimate(v) * std::size_t{kStep} - base_;
  if (key >= buckets_.size()) buckets_.resize(2 * key + 1);
  last_bucket_ = std::max(last_bucket_, key);
  buckets_[key].push_back(v);
}

void PricedSearch::expand(Vertex v) {
  ++expansions_;
  const std::uint32_t left = distances_(robot_, v);
  const std::uint32_t steps = left < shortest_ ? Traffic::delayed(shortest_ - left) : 0;
  const std::uint32_t price =
      std::min(kMostPrice, kStep + kStep * passes_.lossOf(v, robot_, now_ + steps) +
                               kCrowded * traffic_.onto(v, steps));
  for (const Vertex u : instance_.graph().neighbours(v)) {
    const std::uint32_t value = values_[v] + price + kOncoming * traffic_.along(v, u, steps);
    if (value >= values_[u] || value > kMostValue) continue;
    const bool is_new = values_[u] == PricedWays::kUnknown;
    if (is_new && distances_(robot_, u) + estimate(u) > shortest_ + margin_) continue;
    push(u, value, v);
  }
}

void PricedSearch::trace() {
  guide_.assign(1, at_);
  if (values_[at_] == PricedWays::kUnknown) return;  // too dear: the shortest way guides
  while (guide_.back() != instance_.goal(robot_)) guide_.push_back(towards_[guide_.back()]);
}

}  // namespace split_mapf
