#include "search/delayed_robots.h"

#include <algorithm>

namespace split_mapf {

namespace {

// How often a robot is drawn that is late by what was expected.
constexpr std::uint64_t kExpected = 4;
constexpr std::uint64_t kExpectedOf = 5;

/// @param delay_of  the steps that a robot loses.
template <typename DelayOf>
std::uint32_t drawByDelay(std::uint32_t n, DelayOf delay_of, RandomEngine& engine) {
  const auto first = static_cast<std::uint32_t>(drawBelow(engine, n));
  constexpr int kCandidates = 3;
  std::uint32_t best = first;
  std::uint64_t most = 0;
  int found = 0;
  for (std::uint32_t i = 0; i < n && found < kCandidates; ++i) {
    const std::uint32_t robot = first + i < n ? first + i : first + i - n;
    const std::uint64_t delay = delay_of(robot);
    if (delay == 0) continue;
    ++found;
    // Great delays are likelier, not certain.
    const std::uint64_t score = drawBelow(engine, delay + 1);
    if (score >= most) {
      most = score;
      best = robot;
    }
  }
  return best;
}

}  // namespace

std::uint32_t DelayedRobots::draw(const Plan& plan, RandomEngine& engine) const {
  const auto arrival = [&](std::uint32_t robot) { return plan.paths[robot].size() - 1; };
  if (!expected_.empty() && drawBelow(engine, kExpectedOf) < kExpected) {
    const auto lateness = [&](std::uint32_t robot) {
      const std::size_t least = std::max(expected_[robot], soonest_[robot]);
      return arrival(robot) - std::min(arrival(robot), least);
    };
    const auto robots = static_cast<std::uint32_t>(expected_.size());
    const std::uint32_t robot = drawByDelay(robots, lateness, engine);
    if (lateness(robot) > 0) return robot;
  }
  return drawByDelay(
      static_cast<std::uint32_t>(soonest_.size()),
      [&](std::uint32_t robot) { return arrival(robot) - soonest_[robot]; }, engine);
}

std::uint32_t drawLostStep(const Path& path, const HeldDistances& distances, RandomEngine& engine) {
  const auto first = static_cast<std::uint32_t>(drawBelow(engine, path.size()));
  const auto size = static_cast<std::uint32_t>(path.size());
  for (std::uint32_t i = 0; i < size; ++i) {
    const std::uint32_t t = (first + i) % size;
    if (t > 0 && distances(path[t]) >= distances(path[t - 1])) return t;
  }
  return first;
}

}  // namespace split_mapf
