#include "ros/replay/replay_timeline.h"

#include <algorithm>

namespace split_mapf {

void ReplayTimeline::load(double steps, double step_duration_sec) {
  steps_ = steps;
  step_duration_sec_ = step_duration_sec;
  position_ = 0;
  rest_sec_ = 0;
  has_clock_ = false;
}

void ReplayTimeline::advance(double now_sec) {
  const double passed = has_clock_ ? now_sec - clock_sec_ : 0;
  has_clock_ = true;
  clock_sec_ = now_sec;
  if (!playing_ || passed <= 0) return;
  if (position_ < steps_) {
    position_ = std::min(steps_, position_ + passed * speed() / step_duration_sec_);
    return;
  }
  rest_sec_ += passed;
  if (!loop_ || rest_sec_ < kRestSec) return;
  position_ = 0;
  rest_sec_ = 0;
}

void ReplayTimeline::startAnew() {
  hold();
  if (playing_) seek(0);
}

double ReplayTimeline::speed() const {
  if (speed_ > 0) return speed_;
  return std::max(1.0, steps_ * step_duration_sec_ / kWholePlanSec);
}

void ReplayTimeline::play() {
  playing_ = true;
  // Playing on at the end means playing again.
  if (position_ >= steps_) seek(0);
}

void ReplayTimeline::step(double steps) {
  playing_ = false;
  seek(position_ + steps);
}

void ReplayTimeline::seek(double step) {
  position_ = std::clamp(step, 0.0, steps_);
  rest_sec_ = 0;
}

}  // namespace split_mapf
