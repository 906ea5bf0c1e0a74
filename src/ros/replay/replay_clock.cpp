#include "ros/replay/replay_clock.h"

#include <algorithm>

namespace split_mapf {

ReplayClock::Time ReplayClock::read(const ClockReading& now) {
  const double wall_passed = has_wall_ ? std::max(0.0, now.wall_sec - wall_sec_) : 0;
  has_wall_ = true;
  wall_sec_ = now.wall_sec;
  undriven_sec_ = now.driven ? 0 : undriven_sec_ + wall_passed;
  if (undriven_sec_ > kPatienceSec) {
    follows_ros_ = false;
    sec_ += wall_passed;
    return {sec_, false};
  }
  // A publisher that has just come tells the time a little later; until then the old one stands.
  const bool told = now.ros_sec > 0 && (follows_ros_ || now.ros_sec != ros_sec_);
  if (!told) return {sec_, false};
  const bool anew = !follows_ros_ || now.ros_sec < ros_sec_ - kJitterSec;
  follows_ros_ = true;
  ros_sec_ = now.ros_sec;
  sec_ = now.ros_sec;
  return {sec_, anew};
}

}  // namespace split_mapf
