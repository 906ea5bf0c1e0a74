#include "split_mapf/parallel/executor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

namespace split_mapf {
namespace {

TEST(Executor, RunsEveryJobOnce) {
  Executor executor(4);
  std::vector<std::atomic<int>> runs(1000);
  executor.forEach(1000, [&](std::uint32_t i) { ++runs[i]; });
  for (const auto& count : runs) EXPECT_EQ(count, 1);
}

TEST(Executor, StartsTheLongestJobFirst) {
  Executor executor(1);
  std::string order;
  std::vector<Executor::Job> jobs(3);
  jobs[0] = {1, [&] { order += 'a'; }};
  jobs[1] = {3, [&] { order += 'b'; }};
  jobs[2] = {2, [&] { order += 'c'; }};
  executor.run(jobs);
  EXPECT_EQ(order, "bca");
}

TEST(Executor, OnTheCallersThreadJobsMayHaveJobsOfTheirOwn) {
  Executor executor(Executor::OnCallersThread{});
  const std::thread::id caller = std::this_thread::get_id();
  int runs = 0;
  executor.forEach(3, [&](std::uint32_t) {
    executor.forEach(2, [&](std::uint32_t) {
      EXPECT_EQ(std::this_thread::get_id(), caller);
      ++runs;
    });
  });
  EXPECT_EQ(runs, 6);
}

TEST(Executor, KeepsToTheAllowedNumberOfThreads) {
  Executor executor(4);
  std::atomic<int> running{0};
  std::atomic<int> most{0};
  std::vector<Executor::Job> jobs(40);
  for (Executor::Job& job : jobs) {
    job.run = [&] {
      const int now = ++running;
      int seen = most;
      while (seen < now && !most.compare_exchange_weak(seen, now)) {
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      --running;
    };
  }
  executor.run(jobs, 2);
  EXPECT_LE(most, 2);
}

TEST(Executor, RethrowsTheFirstErrorAfterAllOthersHaveEnded) {
  Executor executor(2);
  std::atomic<int> ended{0};
  std::vector<Executor::Job> jobs(10);
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    jobs[i].run = [&ended, i] {
      if (i == 0) throw std::runtime_error("broken");
      ++ended;
    };
  }
  EXPECT_THROW(executor.run(jobs), std::runtime_error);
  EXPECT_EQ(ended, 9);
  executor.forEach(3, [&](std::uint32_t) { ++ended; });
  EXPECT_EQ(ended, 12) << "the workers outlive a job's exception";
}

TEST(Executor, ServesSeveralCallersAtOnce) {
  Executor executor(2);
  std::atomic<int> sum{0};
  std::vector<std::thread> callers;
  callers.reserve(8);
  for (int caller = 0; caller < 8; ++caller) {
    callers.emplace_back([&] { executor.forEach(100, [&](std::uint32_t) { ++sum; }); });
  }
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(sum, 800);
}

TEST(Executor, NoJobsAreDoneAtOnce) {
  Executor executor(2);
  executor.run({});
  executor.forEach(0, [](std::uint32_t) { FAIL(); });
}

TEST(Executor, GivesBackAnExpiredBatchWhileOthersKeepTheWorkersBusy) {
  Executor executor(2);
  std::atomic<bool> release{false};
  std::atomic<int> busy{0};
  std::vector<Executor::Job> long_jobs(2);
  for (Executor::Job& job : long_jobs) {
    job.run = [&] {
      ++busy;
      while (!release) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
  }
  std::thread other([&] { executor.run(long_jobs); });
  while (busy < 2) std::this_thread::yield();
  const Deadline deadline(0.05);
  std::atomic<int> ended{0};
  executor.forEach(
      100, [&](std::uint32_t) { ended += deadline.expired() ? 1 : 0; }, 0, deadline);
  EXPECT_EQ(ended, 100);
  EXPECT_FALSE(release);
  release = true;
  other.join();
}

}  // namespace
}  // namespace split_mapf
