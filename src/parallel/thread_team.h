#pragma once

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace split_mapf {

/// Threads of one search that work through short batches together: the caller and `threads - 1`
/// others, which sleep between batches. A batch of less than a millisecond pays already, which is
/// why a search does not ask a queue of jobs for it. Owned and called by one thread.
class ThreadTeam {
 public:
  /// body(i, member): item i of the batch, in the hands of member 0 .. threads() - 1.
  using Body = std::function<void(std::uint32_t, std::uint32_t)>;

  /// @param threads  at least 1; with 1 everything runs in the caller.
  explicit ThreadTeam(std::uint32_t threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  std::uint32_t threads() const { return static_cast<std::uint32_t>(others_.size()) + 1; }
  /// Calls body for each i in [0, count), each once, and returns when all have ended. The first
  /// exception is rethrown then.
  void forEach(std::uint32_t count, const Body& body);

 private:
  void serve(std::uint32_t member);
  void work(std::uint32_t member, std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;
  std::condition_variable begun_;
  std::condition_variable ended_;
  const Body* body_ = nullptr;  // of the current batch
  std::uint32_t next_ = 0;      // items handed out
  std::uint32_t count_ = 0;
  std::uint32_t busy_ = 0;  // members at work
  std::exception_ptr error_;
  bool leaving_ = false;
  std::vector<std::thread> others_;
};

}  // namespace split_mapf
