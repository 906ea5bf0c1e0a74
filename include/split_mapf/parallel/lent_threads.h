#pragma once

#include <cstdint>

namespace split_mapf {

class ThreadBudget;

/// How many threads a call may use at the same time: the caller's own and, where they have nothing
/// else to do, workers of an executor. No thread is started for it, and no answer depends on how
/// many workers come: they may all be busy elsewhere. Made by Executor::lend(); a value, valid as
/// long as that executor lives.
class LentThreads {
 public:
  /// The caller's own thread and no other.
  LentThreads() = default;
  /// @param most  the caller's own among them, >= 1; no more come than the budget has workers.
  LentThreads(std::uint32_t most, ThreadBudget& budget);

  std::uint32_t most() const { return most_; }
  /// The same, but never more than so many. @pre most >= 1.
  LentThreads atMost(std::uint32_t most) const;
  /// Whose workers come; null: nobody does, and most() is 1.
  ThreadBudget* budget() const { return budget_; }

 private:
  std::uint32_t most_ = 1;
  ThreadBudget* budget_ = nullptr;
};

}  // namespace split_mapf
