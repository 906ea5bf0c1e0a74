#include "ros/server/run_slots.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

namespace split_mapf {
namespace {

void sleepMs(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

TEST(RunSlots, LetOnlySoManyRun) {
  RunSlots slots(2);
  EXPECT_TRUE(slots.acquire(0, Deadline()));
  EXPECT_TRUE(slots.acquire(1, Deadline()));
  EXPECT_FALSE(slots.acquire(2, Deadline(0.05)));
  slots.release();
  EXPECT_TRUE(slots.acquire(3, Deadline(0.05)));
}

TEST(RunSlots, ServeInOrderOfTickets) {
  RunSlots slots(1);
  ASSERT_TRUE(slots.acquire(0, Deadline()));
  std::mutex mutex;
  std::vector<std::uint64_t> order;
  std::vector<std::thread> threads;
  for (const std::uint64_t ticket : {3, 1, 2}) {
    threads.emplace_back([&, ticket] {
      if (!slots.acquire(ticket, Deadline())) return;
      {
        const std::lock_guard<std::mutex> lock(mutex);
        order.push_back(ticket);
      }
      slots.release();
    });
    sleepMs(100);
  }
  slots.release();
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(order, (std::vector<std::uint64_t>{1, 2, 3}));
}

TEST(RunSlots, LetAStoppedWaiterGo) {
  RunSlots slots(1);
  ASSERT_TRUE(slots.acquire(0, Deadline()));
  const auto stop = std::make_shared<StopFlag>();
  std::atomic<bool> ended{false};
  std::thread waiter([&] {
    EXPECT_FALSE(slots.acquire(1, Deadline(-1, stop)));
    ended = true;
  });
  sleepMs(50);
  EXPECT_FALSE(ended);
  stop->request();
  waiter.join();
  EXPECT_TRUE(ended);
  // The one who went does not stand in the way.
  slots.release();
  EXPECT_TRUE(slots.acquire(2, Deadline(1)));
}

}  // namespace
}  // namespace split_mapf
