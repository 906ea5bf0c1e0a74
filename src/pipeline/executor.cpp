#include "split_mapf/pipeline/executor.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <utility>

#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>

namespace split_mapf {

struct Executor::Pool {
  explicit Pool(std::uint32_t threads) : workers(threads) {}
  boost::asio::thread_pool workers;
};

namespace {

/// Jobs that are run together. Workers draw the next one until none is left.
class Batch {
 public:
  Batch(std::vector<Executor::Job> jobs, std::uint32_t drawers)
      : jobs_(std::move(jobs)), drawers_(drawers) {}

  /// The part of one worker.
  void draw() {
    for (;;) {
      const std::size_t i = next_.fetch_add(1);
      if (i >= jobs_.size()) break;
      try {
        jobs_[i].run();
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (!error_) error_ = std::current_exception();
      }
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    if (--drawers_ == 0) done_.notify_all();
  }

  /// Tells that `missing` of the announced workers will not come.
  void withdraw(std::uint32_t missing) {
    const std::lock_guard<std::mutex> lock(mutex_);
    drawers_ -= missing;
    if (drawers_ == 0) done_.notify_all();
  }

  void wait() {
    std::unique_lock<std::mutex> lock(mutex_);
    done_.wait(lock, [this] { return drawers_ == 0; });
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::vector<Executor::Job> jobs_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;
  std::condition_variable done_;
  std::uint32_t drawers_;
  std::exception_ptr error_;
};

}  // namespace

Executor::Executor(std::uint32_t threads)
    : threads_(std::max(threads, 1U)), pool_(std::make_unique<Pool>(threads_)) {}

Executor::~Executor() { pool_->workers.join(); }

void Executor::run(std::vector<Job> jobs, std::uint32_t threads) {
  if (jobs.empty()) return;
  std::stable_sort(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) {
    return a.expected_effort > b.expected_effort;
  });
  const std::uint32_t allowed = threads == 0 ? threads_ : std::min(threads, threads_);
  const auto drawers = static_cast<std::uint32_t>(std::min<std::size_t>(allowed, jobs.size()));
  const auto batch = std::make_shared<Batch>(std::move(jobs), drawers);
  for (std::uint32_t posted = 0; posted < drawers; ++posted) {
    try {
      boost::asio::post(pool_->workers, [batch] { batch->draw(); });
    } catch (const std::bad_alloc&) {
      // Those that are posted can do all the work; without any the caller does it.
      batch->withdraw(drawers - std::max(posted, 1U));
      if (posted == 0) batch->draw();
      break;
    }
  }
  batch->wait();
}

void Executor::forEach(std::uint32_t count, const std::function<void(std::uint32_t)>& body,
                       std::uint32_t threads) {
  const std::uint32_t allowed = threads == 0 ? threads_ : std::min(threads, threads_);
  const std::uint32_t chunks = std::min(count, allowed * 8);
  std::vector<Job> jobs(chunks);
  for (std::uint32_t chunk = 0; chunk < chunks; ++chunk) {
    const auto begin = static_cast<std::uint32_t>(std::uint64_t{count} * chunk / chunks);
    const auto end = static_cast<std::uint32_t>(std::uint64_t{count} * (chunk + 1) / chunks);
    jobs[chunk].run = [&body, begin, end] {
      for (std::uint32_t i = begin; i < end; ++i) body(i);
    };
  }
  run(std::move(jobs), threads);
}

}  // namespace split_mapf
