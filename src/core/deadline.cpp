#include "split_mapf/core/deadline.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace split_mapf {
namespace {

// Longer limits would overflow the clock's representation and mean "never" anyway.
constexpr double kLongestLimitSec = 1e8;

}  // namespace

Deadline::Deadline(double seconds, std::shared_ptr<const StopFlag> stop)
    : limited_(seconds >= 0 && seconds < kLongestLimitSec), stop_(std::move(stop)) {
  if (limited_) {
    end_ = Clock::now() +
           std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  }
}

Deadline Deadline::withStop(std::shared_ptr<const StopFlag> stop) const {
  Deadline other = *this;
  other.stop_ = std::move(stop);
  return other;
}

Deadline Deadline::within(double seconds) const {
  Deadline other(seconds, stop_);
  if (!limited_) return other;
  if (!other.limited_ || end_ < other.end_) return *this;
  return other;
}

double Deadline::remainingSec() const {
  if (!limited_) return std::numeric_limits<double>::infinity();
  return std::max(0.0, std::chrono::duration<double>(end_ - Clock::now()).count());
}

}  // namespace split_mapf
