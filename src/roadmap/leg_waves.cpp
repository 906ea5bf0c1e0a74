#include "roadmap/leg_waves.h"

#include <algorithm>

namespace split_mapf::roadmap {
namespace {

constexpr double kTouch = 1e-6;

/// Whether two centres keep apart that go straight in the same step.
bool keepApart(const Leg& a, const Leg& b, double separation) {
  const double px = a.from.x - b.from.x;
  const double py = a.from.y - b.from.y;
  const double dx = a.to.x - b.to.x - px;
  const double dy = a.to.y - b.to.y - py;
  const double square = dx * dx + dy * dy;
  const double t = square > 0 ? std::clamp(-(px * dx + py * dy) / square, 0.0, 1.0) : 0;
  const double x = px + t * dx;
  const double y = py + t * dy;
  return x * x + y * y >= separation * separation - kTouch;
}

}  // namespace

LegWaves planWaves(const std::vector<Leg>& legs, double clearance, const Deadline& deadline) {
  constexpr std::uint32_t kWaiting = 0xffffffffU;
  LegWaves result;
  result.waves.assign(legs.size(), kWaiting);
  std::size_t waiting = legs.size();
  while (waiting > 0) {
    const std::uint32_t wave = result.count;
    bool moved = false;
    for (std::size_t i = 0; i < legs.size(); ++i) {
      if (result.waves[i] != kWaiting) continue;
      deadline.require();
      const auto lets = [&](std::size_t j) {
        if (i == j) return true;
        const Place stands = result.waves[j] < wave ? legs[j].to : legs[j].from;
        const Leg other = result.waves[j] == wave ? legs[j] : Leg{stands, stands, 0};
        return keepApart(legs[i], other, legs[i].radius + legs[j].radius + clearance);
      };
      bool free = true;
      for (std::size_t j = 0; j < legs.size() && free; ++j) free = lets(j);
      if (!free) continue;
      result.waves[i] = wave;
      moved = true;
      --waiting;
    }
    if (!moved) break;
    ++result.count;
  }
  for (std::uint32_t i = 0; i < legs.size(); ++i) {
    if (result.waves[i] == kWaiting) result.stuck.push_back(i);
  }
  return result;
}

}  // namespace split_mapf::roadmap
