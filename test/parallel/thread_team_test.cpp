#include "parallel/thread_team.h"

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "split_mapf/parallel/executor.h"

namespace split_mapf {
namespace {

/// Runs batches until as many members as asked for have met in one.
void waitForMembers(ThreadTeam& team, std::uint32_t members) {
  for (;;) {
    std::atomic<std::uint32_t> inside{0};
    std::atomic<bool> met{false};
    const Deadline patience(0.005);
    team.forEach(members, [&](std::uint32_t, std::uint32_t) {
      if (++inside == members) met = true;
      while (!met && !patience.expired()) std::this_thread::yield();
    });
    if (met) return;
  }
}

TEST(ThreadTeam, EveryItemIsServedOnceInEveryBatch) {
  for (const std::uint32_t threads : {1U, 2U, 5U}) {
    Executor executor(threads);
    ThreadTeam team(executor.lend());
    EXPECT_EQ(team.threads(), threads);
    for (std::uint32_t batch = 0; batch < 300; ++batch) {
      std::vector<std::atomic<int>> served(batch % 7);
      team.forEach(static_cast<std::uint32_t>(served.size()),
                   [&](std::uint32_t i, std::uint32_t member) {
                     EXPECT_LT(member, threads);
                     ++served[i];
                   });
      for (const std::atomic<int>& count : served) EXPECT_EQ(count, 1);
    }
  }
}

TEST(ThreadTeam, AnExceptionReachesTheCallerAndTheTeamWorksOn) {
  for (const std::uint32_t threads : {1U, 3U}) {
    Executor executor(threads);
    ThreadTeam team(executor.lend());
    const auto fail_at_two = [](std::uint32_t i, std::uint32_t) {
      if (i == 2) throw std::runtime_error("two");
    };
    EXPECT_THROW(team.forEach(5, fail_at_two), std::runtime_error);
    std::atomic<int> served{0};
    team.forEach(4, [&](std::uint32_t, std::uint32_t) { ++served; });
    EXPECT_EQ(served, 4);
  }
}

TEST(ThreadTeam, WhereNothingIsLentTheCallerDoesAll) {
  Executor callers_own(Executor::OnCallersThread{});
  for (const LentThreads& lent : {LentThreads(), callers_own.lend(4)}) {
    ThreadTeam team(lent);
    EXPECT_EQ(team.threads(), 1U);
    const std::thread::id caller = std::this_thread::get_id();
    team.forEach(
        8, [&](std::uint32_t, std::uint32_t) { EXPECT_EQ(std::this_thread::get_id(), caller); });
  }
}

TEST(ThreadTeam, NoMoreComeThanAreAskedFor) {
  Executor executor(8);
  ThreadTeam team(executor.lend(3));
  EXPECT_EQ(team.threads(), 3U);
  waitForMembers(team, 3);
  std::atomic<int> inside{0};
  team.forEach(200, [&](std::uint32_t, std::uint32_t member) {
    EXPECT_LT(member, 3U);
    EXPECT_LE(++inside, 3);
    std::this_thread::yield();
    --inside;
  });
}

TEST(ThreadTeam, AWorkerInATeamLeavesForAJob) {
  Executor executor(2);
  ThreadTeam team(executor.lend());
  waitForMembers(team, 2);
  // One worker is kept, the other is in the team, and sleeps there.
  std::atomic<bool> ended{false};
  std::atomic<bool> begun{false};
  std::vector<Executor::Job> jobs(2);
  jobs[0].run = [&] {
    begun = true;
    while (!ended) std::this_thread::yield();
  };
  jobs[1].run = [&] { ended = true; };
  executor.run(jobs);
  EXPECT_TRUE(begun);
  waitForMembers(team, 2);  // it comes back
}

TEST(ThreadTeam, WorkersOfAFullTeamGoToAnotherThatIsOpened) {
  Executor executor(4);
  ThreadTeam first(executor.lend());
  waitForMembers(first, 4);
  std::thread other([&] {
    ThreadTeam second(executor.lend());
    waitForMembers(second, 3);
  });
  other.join();
  waitForMembers(first, 4);
}

TEST(ThreadTeam, TeamsInEveryWorkerNeedNoOtherThreads) {
  Executor executor(4);
  std::set<std::thread::id> seen;
  std::mutex mutex;
  std::vector<Executor::Job> jobs(12);
  std::atomic<int> served{0};
  for (Executor::Job& job : jobs) {
    job.run = [&] {
      ThreadTeam team(executor.lend());
      for (int batch = 0; batch < 50; ++batch) {
        team.forEach(8, [&](std::uint32_t, std::uint32_t) {
          ++served;
          const std::lock_guard<std::mutex> lock(mutex);
          seen.insert(std::this_thread::get_id());
        });
      }
    };
  }
  executor.run(jobs);
  EXPECT_EQ(served, 12 * 50 * 8);
  EXPECT_LE(seen.size(), 4U);
}

}  // namespace
}  // namespace split_mapf
