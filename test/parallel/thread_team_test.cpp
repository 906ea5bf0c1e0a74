#include "parallel/thread_team.h"

#include <atomic>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace split_mapf {
namespace {

TEST(ThreadTeam, EveryItemIsServedOnceInEveryBatch) {
  for (const std::uint32_t threads : {1U, 2U, 5U}) {
    ThreadTeam team(threads);
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
    ThreadTeam team(threads);
    const auto fail_at_two = [](std::uint32_t i, std::uint32_t) {
      if (i == 2) throw std::runtime_error("two");
    };
    EXPECT_THROW(team.forEach(5, fail_at_two), std::runtime_error);
    std::atomic<int> served{0};
    team.forEach(4, [&](std::uint32_t, std::uint32_t) { ++served; });
    EXPECT_EQ(served, 4);
  }
}

}  // namespace
}  // namespace split_mapf
