#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/parallel/lent_threads.h"

namespace split_mapf {

/// Worker threads shared by every caller. Batches are served in order of arrival, the jobs of a
/// batch longest expected first. A worker without a job helps the searches that threads were lent
/// to; no other threads are ever started. Thread-safe.
class Executor {
 public:
  /// @param threads  number of worker threads, >= 1.
  /// @throws std::system_error when so many cannot be started.
  explicit Executor(std::uint32_t threads);
  struct OnCallersThread {};
  /// No workers: whoever calls does all the jobs, one after another. Unlike the others it may be
  /// used from inside a job.
  explicit Executor(OnCallersThread);
  /// Waits for the running batches.
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  /// Threads that the machine runs at once, as far as it tells; at least 1.
  static std::uint32_t machineThreads();

  std::uint32_t threads() const { return threads_; }
  /// How many of them a caller gets that asks for so many (0: all).
  std::uint32_t threadsFor(std::uint32_t asked) const {
    return asked == 0 ? threads_ : std::min(asked, threads_);
  }

  /// Threads for a search that works in short batches: threadsFor(asked), the caller's own among
  /// them, whether or not that is a worker. The executor outlives what they are lent to.
  LentThreads lend(std::uint32_t asked = 0) const;

  /// One piece of work and how much of it is expected, in any unit.
  struct Job {
    double expected_effort = 0;
    std::function<void()> run;
  };

  /// Runs all jobs on at most `threads` workers (0: all) and returns when the last has ended. The
  /// first exception that a job throws is rethrown here, after all others have ended. Thread-safe;
  /// never call it from inside a job of workers.
  /// Once `deadline` has expired, the caller itself runs what no worker has begun, which is quick
  /// where the jobs poll the same deadline: other batches may keep the workers busy for long.
  void run(std::vector<Job> jobs, std::uint32_t threads = 0, const Deadline& deadline = {});
  /// Calls body(i) for i in [0, count) on at most `threads` workers (0: all), in chunks.
  void forEach(std::uint32_t count, const std::function<void(std::uint32_t)>& body,
               std::uint32_t threads = 0, const Deadline& deadline = {});

 private:
  std::uint32_t threads_;
  std::unique_ptr<ThreadBudget> budget_;  // null: the caller does all
};

}  // namespace split_mapf
