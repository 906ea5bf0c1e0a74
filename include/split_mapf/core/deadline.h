#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <limits>
#include <memory>

namespace split_mapf {

/// A request to stop, raised once and never lowered. A child flag is raised with its parent.
/// Thread-safe; request() is also safe in a signal handler.
class StopFlag {
 public:
  explicit StopFlag(std::shared_ptr<const StopFlag> parent = nullptr)
      : parent_(std::move(parent)) {}
  void request() { requested_.store(true, std::memory_order_relaxed); }
  bool requested() const {
    return requested_.load(std::memory_order_relaxed) || (parent_ && parent_->requested());
  }

 private:
  std::atomic<bool> requested_{false};
  std::shared_ptr<const StopFlag> parent_;
};

/// Thrown out of long work that has no half result to return, such as building a grid, when its
/// deadline has expired. Whoever gave the deadline catches it.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted: the deadline has expired"; }
};

/// Time that is counted instead of measured: one poll of a deadline on it is one tick. So work of
/// one thread ends at the same place on every machine and at any load. A tick stands for about as
/// long as a search takes from one poll to the next. Used by one thread at a time.
class WorkClock {
 public:
  void tick() { ++ticks_; }
  double nowSec() const { return static_cast<double>(ticks_) * kSecPerTick; }

 private:
  static constexpr double kSecPerTick = 1e-4;
  std::uint64_t ticks_ = 0;
};

/// The only answer to "stop now?": a point in time, a stop flag, or both. A value, cheap to copy;
/// thread-safe, but where it counts on a work clock. Every loop that can run long polls expired().
class Deadline {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr double kFinishSec = 0.2;

  /// Never expires.
  Deadline() = default;
  /// Expires `seconds` from now, or when the flag is raised. A negative or infinite number of
  /// seconds means no limit of time.
  explicit Deadline(double seconds, std::shared_ptr<const StopFlag> stop = nullptr);

  /// The same limit of time under another flag (normally a child of this one's).
  Deadline withStop(std::shared_ptr<const StopFlag> stop) const;
  /// The same flag with at most `seconds` from now.
  Deadline within(double seconds) const;
  /// The same flag and limit of time; what within() adds from now on, nowSec() and remainingSec()
  /// are counted by this clock, which each poll makes go on.
  Deadline countedBy(std::shared_ptr<WorkClock> clock) const;
  /// The same flag, kFinishSec later: for what is done to a plan that was found in time, such as
  /// validating and writing it. All that is done together has to end by then.
  /// Of measured time only.
  Deadline forFinish() const;

  bool expired() const { return stopRequested() || timeIsUp(); }
  /// @throws Interrupted when expired.
  void require() const {
    if (expired()) throw Interrupted();
  }
  bool stopRequested() const { return stop_ && stop_->requested(); }
  bool timeIsUp() const {
    if (clock_) clock_->tick();
    return (limited_ && Clock::now() >= end_) || (clock_ && clock_->nowSec() >= counted_end_sec_);
  }
  /// Seconds left, at least 0; infinity without a limit.
  double remainingSec() const;
  /// Seconds since some moment, for differences.
  double nowSec() const;
  const std::shared_ptr<const StopFlag>& stopFlag() const { return stop_; }

 private:
  bool limited_ = false;
  Clock::time_point end_;
  std::shared_ptr<const StopFlag> stop_;
  std::shared_ptr<WorkClock> clock_;
  double counted_end_sec_ = std::numeric_limits<double>::infinity();
};

/// Looks at a deadline once in a few thousand calls, for loops whose turns take nanoseconds.
class SparsePoll {
 public:
  /// @pre deadline outlives this object.
  explicit SparsePoll(const Deadline& deadline) : deadline_(deadline) {}
  /// @throws Interrupted when the deadline has expired.
  void operator()() {
    if ((++calls_ & kMask) == 0) deadline_.require();
  }

 private:
  static constexpr std::uint32_t kMask = (1U << 14U) - 1;
  const Deadline& deadline_;
  std::uint32_t calls_ = 0;
};

}  // namespace split_mapf
