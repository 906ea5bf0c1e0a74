#include "solver/ilp/pricing.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace split_mapf::ilp {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

double Pricing::run(const Window& window, const double* penalties, const RobotRules& rules) {
  window_ = &window;
  const std::uint32_t last = window.latestArrival();
  const std::uint32_t size = window.size();
  now_.assign(size, kInfinity);
  next_.resize(size);
  slot_.resize(std::size_t{last + 1} * size);
  last_slot_.assign(last + 1, 0);
  cost_of_arrival_.assign(last + 1, kInfinity);
  priceStay(penalties, rules);
  now_[0] = 0;
  const bool makespan = ruleOf(objective_).greatest_only;
  if (window.goalPlace() == 0 && (!makespan || last == 0)) cost_of_arrival_[0] = stay_[0];
  for (std::uint32_t t = 0; t < last; ++t) {
    advance(t, penalties, rules);
    if (!makespan) {
      noteArrival(t + 1, penalties + space_.into(t, window.vertex(window.goalPlace())));
    }
    std::swap(now_, next_);
  }
  if (makespan && last > 0) {
    cost_of_arrival_[last] = now_[window.goalPlace()];
    last_slot_[last] = slot_[std::size_t{last} * size + window.goalPlace()];
  }
  double best = kInfinity;
  for (std::uint32_t t = 0; t <= last; ++t) {
    if (!makespan && (t < rules.earliest_arrival || t > rules.latest_arrival)) {
      cost_of_arrival_[t] = kInfinity;
    }
    best = std::min(best, cost_of_arrival_[t]);
  }
  return best;
}

void Pricing::priceStay(const double* penalties, const RobotRules& rules) {
  const std::uint32_t horizon = space_.horizon();
  const Vertex goal = window_->vertex(window_->goalPlace());
  stay_.assign(horizon + 1, 0);
  for (std::uint32_t t = horizon; t-- > 0;) {
    stay_[t] = stay_[t + 1] + penalties[space_.into(t, goal)];
  }
  for (const RobotRules::Post& post : rules.posts) {
    if (post.vertex == goal) continue;
    const auto end = std::min<std::size_t>(post.step + std::size_t{1}, stay_.size());
    std::fill(stay_.begin(), stay_.begin() + static_cast<std::ptrdiff_t>(end), kInfinity);
  }
}

void Pricing::advance(std::uint32_t t, const double* penalties, const RobotRules& rules) {
  const std::uint32_t size = window_->size();
  const std::uint32_t slots = space_.slots();
  std::uint8_t* slot_of = slot_.data() + std::size_t{t + 1} * size;
  for (std::uint32_t place = 0; place < size; ++place) {
    next_[place] = kInfinity;
    if (window_->first(place) > t + 1) {
      std::fill(next_.begin() + place, next_.end(), kInfinity);
      break;
    }
    if (window_->last(place) < t + 1) continue;
    ++expansions_;
    const std::uint32_t* source = window_->sources(place);
    const double* penalty = penalties + space_.into(t, window_->vertex(place));
    double best = kInfinity;
    std::uint8_t best_slot = 0;
    for (std::uint32_t slot = 0; slot < slots; ++slot) {
      if (source[slot] == Window::kNowhere) continue;
      const double cost = now_[source[slot]] + penalty[slot];
      if (cost >= best) continue;
      best = cost;
      best_slot = static_cast<std::uint8_t>(slot);
    }
    next_[place] = best;
    slot_of[place] = best_slot;
  }
  for (const RobotRules::Post& post : rules.posts) {
    if (post.step != t + 1) continue;
    for (std::uint32_t place = 0; place < size; ++place) {
      if (window_->vertex(place) != post.vertex) next_[place] = kInfinity;
    }
  }
}

/// The cheapest move, not wait, into the goal that arrives at step t for good.
void Pricing::noteArrival(std::uint32_t t, const double* into_goal) {
  const std::uint32_t goal = window_->goalPlace();
  if (next_[goal] == kInfinity) return;
  const std::uint32_t* source = window_->sources(goal);
  double best = kInfinity;
  for (std::uint32_t slot = 1; slot < space_.slots(); ++slot) {
    if (source[slot] == Window::kNowhere) continue;
    const double cost = now_[source[slot]] + into_goal[slot];
    if (cost >= best) continue;
    best = cost;
    last_slot_[t] = static_cast<std::uint8_t>(slot);
  }
  cost_of_arrival_[t] = t + best + stay_[t];
}

Path Pricing::path(std::uint32_t arrival) const {
  Path path(arrival + 1);
  std::uint32_t place = window_->goalPlace();
  std::uint8_t slot = last_slot_[arrival];
  for (std::uint32_t t = arrival;; --t) {
    path[t] = window_->vertex(place);
    if (t == 0) return path;
    if (t < arrival) slot = slot_[std::size_t{t} * window_->size() + place];
    place = window_->sources(place)[slot];
  }
}

}  // namespace split_mapf::ilp
