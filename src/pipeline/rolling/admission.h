#pragma once

#include <algorithm>
#include <cstdint>

namespace split_mapf::rolling {

/// How many robots of a crowd go at a time; the others rest, and make room. Half as many where a
/// jam has formed, as it is not undone while everybody presses into it, and slowly more again where
/// there is none. Source: additive increase, multiplicative decrease, as networks have it (Chiu,
/// Jain 1989); here for robots. Not thread-safe.
class Admission {
 public:
  /// Takes notice of a crowd as it stands. @param stuck  robots that have gained nothing for long
  void note(std::uint32_t robots, std::uint32_t stuck, std::uint64_t now, std::uint32_t window) {
    if (now < next_cut_) return;
    if (stuck * kJamShare > robots) {
      const std::uint32_t least = std::max(1U, robots / kLeastShare);
      limit_ = std::max(least, std::min(limit_, robots) / 2);
      next_cut_ = now + std::uint64_t{kWindowsToCut} * window;
      next_rise_ = now + std::uint64_t{kWindowsToRise} * window;
    } else if (limit_ != kNone && now >= next_rise_) {
      limit_ += std::max(1U, robots / kRiseShare);
      if (limit_ >= robots) limit_ = kNone;
      next_rise_ = now + std::uint64_t{kWindowsToRise} * window;
    }
  }
  /// Of a fleet that is no crowd.
  void open() { limit_ = kNone; }
  std::uint32_t limit() const { return limit_; }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;
  // One robot in so many: is stuck at least in a jam; goes always; goes more in each rise.
  static constexpr std::uint32_t kJamShare = 10;
  static constexpr std::uint32_t kLeastShare = 10;
  static constexpr std::uint32_t kRiseShare = 16;
  static constexpr std::uint32_t kWindowsToCut = 4;
  static constexpr std::uint32_t kWindowsToRise = 8;

  std::uint32_t limit_ = kNone;
  std::uint64_t next_cut_ = 0;
  std::uint64_t next_rise_ = 0;
};

}  // namespace split_mapf::rolling
