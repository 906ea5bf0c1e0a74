#pragma once

#include <cstdint>

#include "split_mapf/core/deadline.h"

namespace split_mapf {

/// How much a run has searched, and whether it has to stop.
class Effort {
 public:
  /// @param limit  expanded states; 0: none. The deadline outlives this object.
  Effort(std::uint64_t limit, const Deadline& deadline) : limit_(limit), deadline_(deadline) {}

  /// Counts a search. @return whether to go on.
  bool spend(std::uint64_t expansions, bool interrupted) {
    expansions_ += expansions;
    interrupted_ = interrupted_ || interrupted;
    return !stopped();
  }
  bool exhausted() const { return limit_ > 0 && expansions_ > limit_; }
  bool stopped() {
    interrupted_ = interrupted_ || deadline_.expired();
    return interrupted_ || exhausted();
  }
  std::uint64_t expansions() const { return expansions_; }
  const Deadline& deadline() const { return deadline_; }

 private:
  std::uint64_t limit_;
  const Deadline& deadline_;
  std::uint64_t expansions_ = 0;
  bool interrupted_ = false;
};

}  // namespace split_mapf
