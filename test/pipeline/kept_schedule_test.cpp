#include "pipeline/kept_schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "search/departures.h"
#include "search/ejection_chain.h"
#include "search/reservation_table.h"
#include "split_mapf/core/precedence.h"
#include "split_mapf/core/random.h"
#include "split_mapf/core/validate.h"
#include "support/placed_plan.h"
#include "support/random_plan.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kRobots = 40;

/// Robots that carry out a plan, some of which stand when it is to go on.
class KeptScheduleTest : public ::testing::Test {
 protected:
  void draw(std::uint64_t seed) {
    RandomEngine engine(seed);
    const Instance whole = test::generatedInstance(12, 0.15, kRobots, seed);
    const auto& grid = whole.sharedGrid();
    schedule_.plan = test::planWithDelays(whole);
    trimToArrival(schedule_.plan);
    passed_ = 1 + static_cast<std::uint32_t>(drawBelow(engine, 4));
    departures_.assign(kRobots, 0);
    for (std::uint32_t& step : departures_) {
      if (drawBelow(engine, 10) == 0) step = 1 + static_cast<std::uint32_t>(drawBelow(engine, 8));
    }
    Plan tail;
    for (const Path& path : schedule_.plan.paths) {
      const std::size_t first = std::min<std::size_t>(passed_, path.size() - 1);
      tail.paths.emplace_back(path.begin() + static_cast<std::ptrdiff_t>(first), path.end());
    }
    const Precedence order(tail, grid->size());
    rest_ = planOf(order, earliestSteps(order, departures_));
    trimToArrival(rest_);
    instance_ = std::make_unique<Instance>(test::instanceOf(grid, rest_));
    draft_ = draftBySchedule(schedule_, rest_, departures_, passed_, grid->size());
  }

  bool isPlaced(std::uint32_t robot) const {
    const auto& unplaced = draft_.unplaced;
    return std::find(unplaced.begin(), unplaced.end(), robot) == unplaced.end();
  }

  void expectDepartsInTime(const Plan& plan, std::uint32_t robot) const {
    for (std::uint32_t t = 0; t <= departures_[robot]; ++t) {
      ASSERT_EQ(positionAt(plan.paths[robot], t), instance_->start(robot)) << "robot " << robot;
    }
  }

  KeptSchedule schedule_;
  std::uint32_t passed_ = 0;
  std::vector<std::uint32_t> departures_;
  Plan rest_;
  std::unique_ptr<Instance> instance_;
  ScheduleDraft draft_;
};

TEST_F(KeptScheduleTest, HasRobotsGoOnWithoutConflicts) {
  std::size_t placed = 0;
  std::size_t unplaced = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    draw(seed);
    for (std::uint32_t robot = 0; robot < kRobots; ++robot) {
      const Path& path = draft_.plan.paths[robot];
      expectDepartsInTime(draft_.plan, robot);
      ASSERT_EQ(path.back(), instance_->goal(robot));
      ++(isPlaced(robot) ? placed : unplaced);
      if (isPlaced(robot)) continue;
      ASSERT_EQ(path, rest_.paths[robot]);
      // Nobody comes where it stands.
      for (std::uint32_t t = 0; t <= departures_[robot]; ++t) {
        for (std::uint32_t other = 0; other < kRobots; ++other) {
          if (other == robot || !isPlaced(other)) continue;
          ASSERT_NE(positionAt(draft_.plan.paths[other], t), path.front());
        }
      }
    }
    for (const Violation& found : validate(*instance_, draft_.plan)) {
      EXPECT_FALSE(isPlaced(found.robot) && isPlaced(found.other)) << found.message;
    }
  }
  EXPECT_GT(placed, 1000U);
  EXPECT_GT(unplaced, 100U);
}

TEST_F(KeptScheduleTest, OthersFindPlacesAtNoMoreThanTheOrdersCost) {
  std::size_t found = 0;
  std::uint64_t before = 0;
  std::uint64_t after = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    draw(seed);
    if (draft_.saved == 0 || draft_.unplaced.empty()) continue;
    Plan placed = draft_.plan;
    for (const std::uint32_t robot : draft_.unplaced) placed.paths[robot].clear();
    ReservationTable table(instance_->graph().size(), placed);
    EjectionChain chain(*instance_, kForever - 1, Departures(departures_));
    RepairStart start;
    start.unplaced = draft_.unplaced;
    for (std::uint32_t robot = 0; robot < kRobots; ++robot) {
      if (departures_[robot] > 0) start.standing.push_back(robot);
    }
    start.spare = draft_.saved;
    start.slack = 4;
    start.reach = 16;
    start.searches = 40;
    if (!chain.repair(start, draft_.plan, table, Deadline())) continue;
    ++found;
    Plan plan = draft_.plan;
    for (const PathChange& change : chain.changes()) plan.paths[change.robot] = change.path;
    ASSERT_TRUE(validate(*instance_, plan).empty());
    for (std::uint32_t robot = 0; robot < kRobots; ++robot) expectDepartsInTime(plan, robot);
    ASSERT_LE(sumOfCostsOf(plan), sumOfCostsOf(rest_));
    before += sumOfCostsOf(rest_);
    after += sumOfCostsOf(plan);
  }
  EXPECT_GT(found, 20U);
  EXPECT_LT(after, before);
}

TEST(KeptSchedule, ARobotThatIsAheadWaitsForItsTurn) {
  // Robot 0 waits two steps at 0 for robot 1 to cross, in vain: it has gone on already.
  const KeptSchedule schedule = {{{{0, 0, 0, 1, 2}, {5, 4, 3}}}};
  const Plan rest = {{{1, 2}, {4, 3}}};
  const ScheduleDraft draft = draftBySchedule(schedule, rest, {0, 0}, 1, 6);
  EXPECT_TRUE(draft.unplaced.empty());
  EXPECT_EQ(draft.plan.paths[0], (Path{1, 1, 1, 2}));
  EXPECT_EQ(draft.plan.paths[1], (Path{4, 3}));
}

TEST(KeptSchedule, OfOtherRobotsOrGoalsIsNone) {
  const Plan rest = {{{1, 2}, {4, 3}}};
  EXPECT_EQ(draftBySchedule({}, rest, {0, 0}, 1, 6).unplaced.size(), 2U);
  const KeptSchedule elsewhere = {{{{1, 2}, {4, 5}}}};
  EXPECT_EQ(draftBySchedule(elsewhere, rest, {0, 0}, 0, 6).unplaced,
            (std::vector<std::uint32_t>{1}));
}

}  // namespace
}  // namespace split_mapf
