#include "split_mapf/core/deadline.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace split_mapf {
namespace {

// Longer limits would overflow the clock's representation and mean "never" anyway.
constexpr double kLongestLimitSec = 1e8;

Deadline::Clock::duration toTicks(double seconds) {
  return std::chrono::duration_cast<Deadline::Clock::duration>(
      std::chrono::duration<double>(seconds));
}

}  // namespace

Deadline::Deadline(double seconds, std::shared_ptr<const StopFlag> stop)
    : limited_(seconds >= 0 && seconds < kLongestLimitSec), stop_(std::move(stop)) {
  if (limited_) end_ = Clock::now() + toTicks(seconds);
}

Deadline Deadline::withStop(std::shared_ptr<const StopFlag> stop) const {
  Deadline other = *this;
  other.stop_ = std::move(stop);
  return other;
}

Deadline Deadline::within(double seconds) const {
  if (clock_) {
    Deadline other = *this;
    if (seconds >= 0) {
      other.counted_end_sec_ = std::min(counted_end_sec_, clock_->nowSec() + seconds);
    }
    return other;
  }
  Deadline other(seconds, stop_);
  if (!limited_) return other;
  if (!other.limited_ || end_ < other.end_) return *this;
  return other;
}

Deadline Deadline::countedBy(std::shared_ptr<WorkClock> clock) const {
  Deadline other = *this;
  other.clock_ = std::move(clock);
  return other;
}

double Deadline::nowSec() const {
  if (clock_) return clock_->nowSec();
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

Deadline Deadline::forFinish() const {
  Deadline other = *this;
  other.end_ += toTicks(kFinishSec);
  return other;
}

double Deadline::remainingSec() const {
  if (clock_) return std::max(0.0, counted_end_sec_ - clock_->nowSec());
  if (!limited_) return std::numeric_limits<double>::infinity();
  return std::max(0.0, std::chrono::duration<double>(end_ - Clock::now()).count());
}

}  // namespace split_mapf
