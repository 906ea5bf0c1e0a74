#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <set>

#include "split_mapf/core/deadline.h"

namespace split_mapf {

/// Lets a limited number of goals run at once; the others wait in order of arrival. Thread-safe.
class RunSlots {
 public:
  explicit RunSlots(std::uint32_t slots) : free_(slots) {}

  /// Waits for a slot until `deadline` expires. True when the
  /// caller has one; it gives it back by release(). Whoever waits with the smallest ticket comes
  /// first.
  /// @pre no two callers wait with the same ticket.
  bool acquire(std::uint64_t ticket, const Deadline& deadline);
  void release();

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::uint32_t free_;
  std::set<std::uint64_t> waiting_;
};

}  // namespace split_mapf
