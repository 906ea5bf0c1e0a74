#include "core/standing_times.h"

#include <algorithm>

namespace split_mapf {

void StandingTimes::observe(std::uint32_t robot, bool delayed) {
  std::uint32_t& stood = stood_[robot];
  if (delayed) {
    ++stood;
    return;
  }
  if (stood == 0) return;
  if (lasted_.size() <= stood) lasted_.resize(stood + std::size_t{1}, 0);
  ++lasted_[stood];
  stood = 0;
}

std::uint32_t StandingTimes::expected(std::uint32_t robot) const {
  const std::uint32_t stood = stood_[robot];
  if (stood == 0) return 0;
  std::uint64_t count = 0;
  std::uint64_t left = 0;
  for (std::size_t length = stood; length < lasted_.size(); ++length) {
    count += lasted_[length];
    left += lasted_[length] * (length - stood + 1);
  }
  // One that outlasts all seen may end at any moment.
  if (count == 0) return lasted_.empty() ? stood : 1;
  return static_cast<std::uint32_t>((left + count / 2) / count);
}

}  // namespace split_mapf
