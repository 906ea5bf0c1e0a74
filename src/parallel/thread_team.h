#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>

#include "parallel/thread_budget.h"
#include "split_mapf/parallel/lent_threads.h"

namespace split_mapf {

/// Threads of one search that work through short batches together: the caller and the workers lent
/// to it, which come when they have nothing else to do, sleep between batches and go when a job of
/// their executor waits. A batch of less than a millisecond pays already, which is why a search
/// does not ask a queue of jobs for it. Owned and called by one thread.
class ThreadTeam : private ThreadBudget::Host {
 public:
  /// body(i, member): item i of the batch, in the hands of member 0 .. threads() - 1.
  using Body = std::function<void(std::uint32_t, std::uint32_t)>;

  /// Where nothing is lent, everything runs in the caller.
  explicit ThreadTeam(const LentThreads& lent);
  ~ThreadTeam() override;
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  /// Members that there may be at most.
  std::uint32_t threads() const { return lent_.most(); }
  /// Calls body for each i in [0, count), each once, and returns when all have ended. The first
  /// exception is rethrown then.
  void forEach(std::uint32_t count, const Body& body);

 private:
  void serve(std::uint32_t member) override;
  void recall() override;
  void dismiss() override;
  bool mayLeave() const { return leaving_ || recalled_ > 0; }
  void work(std::uint32_t member, std::unique_lock<std::mutex>& lock);

  const LentThreads lent_;
  std::mutex mutex_;
  std::condition_variable begun_;
  std::condition_variable ended_;
  const Body* body_ = nullptr;  // of the current batch
  std::uint32_t next_ = 0;      // items handed out
  std::uint32_t count_ = 0;
  std::uint32_t busy_ = 0;      // members at work
  std::uint32_t recalled_ = 0;  // members that shall leave
  std::exception_ptr error_;
  bool leaving_ = false;
};

}  // namespace split_mapf
