#include "ros/server/plan_stream.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace split_mapf {
namespace {

PlanReport costing(std::uint64_t sum_of_costs) {
  PlanReport report;
  report.sum_of_costs = sum_of_costs;
  return report;
}

/// A stream whose clock the test sets, and what came out of it.
class PlanStreamTest : public ::testing::Test {
 protected:
  void publishAt(int ms) {
    stream_.publishDue(PlanStream::Clock::time_point(std::chrono::milliseconds(ms)));
  }
  std::vector<std::uint64_t> published_;
  PlanStream stream_{
      [this](const PlanReport& report) { published_.push_back(report.sum_of_costs); }};
};

TEST_F(PlanStreamTest, PublishesEachPlanOnce) {
  publishAt(0);
  EXPECT_TRUE(published_.empty());
  stream_.offer(costing(9));
  publishAt(1);
  publishAt(2000);
  EXPECT_EQ(published_, (std::vector<std::uint64_t>{9}));
}

TEST_F(PlanStreamTest, KeepsTheNewestUntilItsTimeHasCome) {
  stream_.offer(costing(9));
  publishAt(1000);
  stream_.offer(costing(8));
  publishAt(1050);
  stream_.offer(costing(7));
  publishAt(1249);
  EXPECT_EQ(published_, (std::vector<std::uint64_t>{9}));
  publishAt(1250);
  EXPECT_EQ(published_, (std::vector<std::uint64_t>{9, 7}));
}

TEST_F(PlanStreamTest, PublishesFourASecondAtMost) {
  std::size_t before = 0;
  for (int ms = 0; ms < 5000; ++ms) {
    stream_.offer(costing(static_cast<std::uint64_t>(10000 - ms)));
    publishAt(ms);
    if (ms % 1000 != 999) continue;
    EXPECT_EQ(published_.size() - before, 4U);
    before = published_.size();
  }
}

TEST_F(PlanStreamTest, PublishesNothingOnceItIsClosed) {
  stream_.offer(costing(9));
  stream_.close();
  publishAt(0);
  stream_.offer(costing(8));
  publishAt(5000);
  EXPECT_TRUE(published_.empty());
}

TEST(PlanStream, IsClosedOnlyWhenThePlanInHandIsOut) {
  std::atomic<bool> begun{false};
  std::atomic<bool> may_end{false};
  std::atomic<bool> ended{false};
  PlanStream stream([&](const PlanReport&) {
    begun = true;
    while (!may_end) std::this_thread::yield();
    ended = true;
  });
  stream.offer(costing(9));
  std::thread publisher([&] { stream.publishDue(); });
  while (!begun) std::this_thread::yield();
  std::thread closer([&] {
    stream.close();
    EXPECT_TRUE(ended);
  });
  stream.publishDue();  // another thread is at it
  may_end = true;
  publisher.join();
  closer.join();
  EXPECT_TRUE(ended);
}

}  // namespace
}  // namespace split_mapf
