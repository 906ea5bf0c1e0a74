#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>

#include "split_mapf/core/plan_report.h"

namespace split_mapf {

/// The better plans of one goal on their way out while the goal is still being refined. Of plans
/// that come faster than they may be published the newest is kept, so the best plan is out a moment
/// later, and planning never waits for a message. Thread-safe.
class PlanStream {
 public:
  using Clock = std::chrono::steady_clock;
  using Publish = std::function<void(const PlanReport&)>;
  /// Between two plans. Four of these and the result's own plan make five a second at most.
  static constexpr std::chrono::milliseconds kPeriod{250};

  /// @param publish  called by publishDue() alone, one call at a time, never after close().
  explicit PlanStream(Publish publish) : publish_(std::move(publish)) {}

  /// Takes a plan that has passed the validator, in place of one that still waits. Cost: a copy.
  void offer(const PlanReport& report);
  /// Publishes what waits, if the last plan went out a period ago or more. Called again and again,
  /// from any thread; returns at once where another thread is publishing.
  void publishDue(Clock::time_point now = Clock::now());
  /// Drops what waits, and returns when nothing is being published any more, and never will be.
  void close();

 private:
  const Publish publish_;
  std::mutex publishing_;  ///< held during a call of publish_, and around closed_ and last_
  bool closed_ = false;
  Clock::time_point last_{};
  bool has_published_ = false;
  std::mutex waiting_mutex_;
  std::shared_ptr<const PlanReport> waiting_;
};

}  // namespace split_mapf
