#pragma once

#include <atomic>
#include <functional>
#include <memory>

#include "split_mapf/core/deadline.h"

namespace split_mapf {

/// Calls into code that may never come back: of one plug-in. Thread-safe.
class CallWatch {
 public:
  /// From the deadline on.
  static constexpr double kGraceSec = 0.5;

  /// Runs `body` in a thread of its own, and waits for it. True when it has ended; what it threw is
  /// rethrown. False when it has not, kGraceSec after the deadline has expired: then it goes on
  /// alone, and is destroyed when it ends. So it may use nothing but what it owns, and such that
  /// several threads may use.
  /// @throws std::bad_alloc when no thread can be started.
  bool call(std::function<void()> body, const Deadline& deadline);
  /// Of those that were given up, how many have not ended yet.
  int abandoned() const { return *abandoned_; }

 private:
  std::shared_ptr<std::atomic<int>> abandoned_ = std::make_shared<std::atomic<int>>(0);
};

}  // namespace split_mapf
