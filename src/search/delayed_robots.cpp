#include "search/delayed_robots.h"

namespace split_mapf {

namespace {

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

std::uint32_t drawDelayed(const Instance& instance, const Plan& plan, RandomEngine& engine) {
  return drawByDelay(
      instance.robots(),
      [&](std::uint32_t robot) {
        return plan.paths[robot].size() - 1 - instance.shortestLength(robot);
      },
      engine);
}

std::uint32_t drawDelayed(const std::vector<std::uint32_t>& soonest, const Plan& plan,
                          RandomEngine& engine) {
  return drawByDelay(
      static_cast<std::uint32_t>(soonest.size()),
      [&](std::uint32_t robot) { return plan.paths[robot].size() - 1 - soonest[robot]; }, engine);
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
