#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <iterator>
#include <thread>
#include <vector>

#include "split_mapf/core/validate.h"
#include "split_mapf/pipeline/planner.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

/// Of this process; 0 where the system does not tell.
std::size_t countThreads() {
  std::error_code error;
  const std::filesystem::directory_iterator tasks("/proc/self/task", error);
  if (error) return 0;
  return static_cast<std::size_t>(std::distance(begin(tasks), end(tasks)));
}

/// The most threads that there are at a time while it lives, its own left out.
class MostThreads {
 public:
  MostThreads() : thread_([this] { watch(); }) {}
  std::size_t end() {
    ended_ = true;
    thread_.join();
    return most_ - 1;
  }

 private:
  void watch() {
    while (!ended_) {
      most_ = std::max(most_, countThreads());
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
  }

  std::size_t most_ = 1;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

TEST(ThreadCount, FourGoalsOnFourWorkersStartNoOthers) {
  if (countThreads() == 0) GTEST_SKIP() << "there is no /proc/self/task";
  const Instance instance = test::generatedInstance(40, 0.1, 400);
  Executor executor(4);
  const Planner planner(builtinSolvers(), executor);
  const std::vector<const char*> solvers = {"conflict_optimizer", "prioritized", "lacam", "auto"};
  std::vector<PlanReport> reports(solvers.size());
  const std::size_t before = countThreads();
  MostThreads most;
  std::vector<std::thread> goals;
  for (std::size_t i = 0; i < solvers.size(); ++i) {
    goals.emplace_back([&, i] {
      PlanRequest request;
      request.solver = solvers[i];
      request.split = i == 2 ? "2t" : "none";
      request.straighten = true;
      reports[i] = planner.plan(instance, request, Deadline(30));
    });
  }
  for (std::thread& goal : goals) goal.join();
  EXPECT_LE(most.end(), before + goals.size()) << "beside the goals' own threads";
  for (const PlanReport& report : reports) {
    ASSERT_TRUE(report.plan) << report.message;
    EXPECT_TRUE(validate(instance, *report.plan).empty());
  }
}

}  // namespace
}  // namespace split_mapf
