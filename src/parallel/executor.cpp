#include "split_mapf/parallel/executor.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <thread>
#include <utility>

#include "parallel/thread_budget.h"

namespace split_mapf {
namespace {

// A stop flag cannot wake a sleeper, so that a waiting caller looks at its deadline this often.
constexpr std::chrono::milliseconds kPollInterval(20);

/// Jobs that are run together. Workers draw the next one until none is left.
class Batch {
 public:
  explicit Batch(std::vector<Executor::Job> jobs)
      : jobs_(std::move(jobs)), unfinished_(jobs_.size()) {}

  /// The part of one worker. One that comes late finds nothing to do.
  void draw() {
    for (;;) {
      const std::size_t i = next_.fetch_add(1);
      if (i >= jobs_.size()) return;
      std::exception_ptr error;
      try {
        jobs_[i].run();
      } catch (...) {
        error = std::current_exception();
      }
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!error_) error_ = error;
      if (--unfinished_ == 0) done_.notify_all();
    }
  }

  /// Waits for the last job. Once the deadline has expired, the caller draws too: all workers may
  /// be busy with other batches for long.
  void wait(const Deadline& deadline) {
    std::unique_lock<std::mutex> lock(mutex_);
    const auto is_done = [this] { return unfinished_ == 0; };
    while (!done_.wait_for(lock, kPollInterval, is_done)) {
      if (!deadline.expired()) continue;
      lock.unlock();
      draw();
      lock.lock();
      done_.wait(lock, is_done);
    }
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::vector<Executor::Job> jobs_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::condition_variable done_;
  std::size_t unfinished_;
  std::exception_ptr error_;
};

}  // namespace

Executor::Executor(std::uint32_t threads)
    : threads_(std::max(threads, 1U)), budget_(std::make_unique<ThreadBudget>(threads_)) {}

Executor::Executor(OnCallersThread /*tag*/) : threads_(1) {}

Executor::~Executor() = default;

std::uint32_t Executor::machineThreads() {
  return std::max(1U, std::thread::hardware_concurrency());
}

LentThreads Executor::lend(std::uint32_t asked) const {
  return budget_ ? LentThreads(threadsFor(asked), *budget_) : LentThreads();
}

void Executor::run(std::vector<Job> jobs, std::uint32_t threads, const Deadline& deadline) {
  if (jobs.empty()) return;
  std::stable_sort(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) {
    return a.expected_effort > b.expected_effort;
  });
  const std::uint32_t allowed = threadsFor(threads);
  const std::size_t drawers = budget_ ? std::min<std::size_t>(allowed, jobs.size()) : 0;
  const auto batch = std::make_shared<Batch>(std::move(jobs));
  for (std::size_t posted = 0; posted < drawers; ++posted) {
    try {
      budget_->post([batch] { batch->draw(); });
    } catch (const std::bad_alloc&) {
      // Those that are posted can do all the work; without any the caller does it.
      if (posted == 0) batch->draw();
      break;
    }
  }
  if (!budget_) batch->draw();
  batch->wait(deadline);
}

void Executor::forEach(std::uint32_t count, const std::function<void(std::uint32_t)>& body,
                       std::uint32_t threads, const Deadline& deadline) {
  const std::uint32_t allowed = threadsFor(threads);
  const std::uint32_t chunks = std::min(count, allowed * 8);
  std::vector<Job> jobs(chunks);
  for (std::uint32_t chunk = 0; chunk < chunks; ++chunk) {
    const auto begin = static_cast<std::uint32_t>(std::uint64_t{count} * chunk / chunks);
    const auto end = static_cast<std::uint32_t>(std::uint64_t{count} * (chunk + 1) / chunks);
    jobs[chunk].run = [&body, begin, end] {
      for (std::uint32_t i = begin; i < end; ++i) body(i);
    };
  }
  run(std::move(jobs), threads, deadline);
}

}  // namespace split_mapf
