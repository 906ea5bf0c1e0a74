#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
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

/// The only answer to "stop now?": a point in time, a stop flag, or both. A value, cheap to copy;
/// thread-safe. Every loop that can run long polls expired().
class Deadline {
 public:
  using Clock = std::chrono::steady_clock;

  /// Never expires.
  Deadline() = default;
  /// Expires `seconds` from now, or when the flag is raised. A negative or infinite number of
  /// seconds means no limit of time.
  explicit Deadline(double seconds, std::shared_ptr<const StopFlag> stop = nullptr);

  /// The same limit of time under another flag (normally a child of this one's).
  Deadline withStop(std::shared_ptr<const StopFlag> stop) const;
  /// The same flag with at most `seconds` from now.
  Deadline within(double seconds) const;

  bool expired() const { return stopRequested() || timeIsUp(); }
  /// @throws Interrupted when expired.
  void require() const {
    if (expired()) throw Interrupted();
  }
  bool stopRequested() const { return stop_ && stop_->requested(); }
  bool timeIsUp() const { return limited_ && Clock::now() >= end_; }
  /// Seconds left, at least 0; infinity without a limit.
  double remainingSec() const;
  const std::shared_ptr<const StopFlag>& stopFlag() const { return stop_; }

 private:
  bool limited_ = false;
  Clock::time_point end_;
  std::shared_ptr<const StopFlag> stop_;
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
