#pragma once

#include <mutex>
#include <utility>

#include "ros/convert/options_loader.h"

namespace split_mapf {

/// What goals leave open is taken from here, when their options are read: who has read them keeps
/// them. Thread-safe.
class GoalDefaults {
 public:
  explicit GoalDefaults(GoalOptions options) : options_(std::move(options)) {}

  GoalOptions get() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return options_;
  }
  /// @pre the options have been checked.
  void set(GoalOptions options) {
    const std::lock_guard<std::mutex> lock(mutex_);
    options_ = std::move(options);
  }

 private:
  mutable std::mutex mutex_;
  GoalOptions options_;
};

}  // namespace split_mapf
