// Rolling fleets of discs: tasks come one by one, robots are late, die, and cells are blocked.

#include <iostream>
#include <set>

#include <gtest/gtest.h>

#include "fleet/rolling_world.h"
#include "support/ascii_grid.h"
#include "support/long_run.h"

namespace split_mapf {
namespace {

using test::rollingOptions;
using test::RollingWorld;

const std::vector<std::string> hall_rows = {"............", ".##.##.##.#.", "............",
                                            ".##.##.##.#.", "............", "............"};

Vertex at(const RollingWorld& world, int x, int y) { return world.grid_->vertexAt({x, y}); }

std::vector<Vertex> firstPlaces(const Grid& grid, std::uint32_t robots) {
  std::vector<Vertex> places;
  for (std::uint32_t i = 0; i < robots; ++i) places.push_back(i * (grid.size() / robots));
  return places;
}

struct Hall {
  explicit Hall(std::uint32_t robots, std::uint64_t seed = 1,
                const FleetOptions& options = rollingOptions())
      : grid(test::gridFromAscii(hall_rows)),
        world(grid, firstPlaces(*grid, robots), options, seed) {}
  std::shared_ptr<const Grid> grid;
  RollingWorld world;
};

TEST(RollingFleet, BringsOneOfSeveralRobotsToItsGoal) {
  Hall hall(4);
  const std::uint64_t task = hall.world.send("r2", at(hall.world, 11, 0));
  ASSERT_TRUE(hall.world.runUntilDone(600));
  EXPECT_EQ(hall.world.ends_[task].end, TaskEnd::kArrived);
  EXPECT_EQ(hall.world.fleet_->vertexOf(2), at(hall.world, 11, 0));
  EXPECT_TRUE(hall.world.checker_.isClear()) << hall.world.checker_.closest();
}

TEST(RollingFleet, EndsAnOlderTaskOfARobotByANewerOne) {
  Hall hall(4);
  const std::uint64_t older = hall.world.send("r0", at(hall.world, 11, 5));
  for (int i = 0; i < 25; ++i) hall.world.tick();
  const std::uint64_t newer = hall.world.send("r0", at(hall.world, 0, 5));
  ASSERT_TRUE(hall.world.runUntilDone(600));
  EXPECT_EQ(hall.world.ends_[older].end, TaskEnd::kPreempted);
  EXPECT_EQ(hall.world.ends_[newer].end, TaskEnd::kArrived);
}

TEST(RollingFleet, StopsACancelledRobotBehindWhatIsReleased) {
  Hall hall(1);
  const std::uint64_t task = hall.world.send("r0", at(hall.world, 11, 5));
  for (int i = 0; i < 30; ++i) hall.world.tick();
  hall.world.cancel(task);
  const FleetExecution& fleet = *hall.world.fleet_;
  const std::uint32_t released = fleet.status(hall.world.now_)[0].released_until;
  for (int i = 0; i < 100; ++i) hall.world.tick();
  EXPECT_EQ(hall.world.ends_[task].end, TaskEnd::kCancelled);
  EXPECT_LE(fleet.status(hall.world.now_)[0].sequence, released);
  EXPECT_NE(fleet.vertexOf(0), at(hall.world, 11, 5));
  EXPECT_TRUE(fleet.graph().isDone(0));
}

TEST(RollingFleet, GivesATaskToTheNearestIdleRobots) {
  Hall hall(4);
  std::vector<std::uint64_t> tasks;
  for (std::uint32_t robot = 0; robot < 4; ++robot) {
    const Vertex place = hall.world.fleet_->vertexOf(robot);
    for (const Vertex next : hall.grid->graph().neighbours(place)) {
      tasks.push_back(hall.world.send("", next));
      break;
    }
  }
  ASSERT_TRUE(hall.world.runUntilDone(300));
  for (std::uint32_t robot = 0; robot < 4; ++robot) {
    EXPECT_EQ(hall.world.ends_[tasks[robot]].robot, "r" + std::to_string(robot));
  }
}

/// Idle robots that cannot come to any task had it look for work without a pause.
TEST(RollingFleet, HasNoNewsWhereIdleRobotsCanDoNothing) {
  const auto grid = test::gridFromAscii({"....", "####", "...."});
  RollingWorld world(grid, {0, 1, 2, 4}, rollingOptions(), 1, 2);
  world.send("r3", at(world, 3, 2));
  world.tick();
  world.send("", at(world, 1, 2));
  world.send("", at(world, 2, 2));
  EXPECT_TRUE(world.tasks_->hasNews());
  world.tick();
  ASSERT_EQ(world.tasks_->active(), 1U);
  EXPECT_EQ(world.tasks_->waiting(), 2U);
  EXPECT_FALSE(world.tasks_->hasNews());
}

TEST(RollingFleet, GivesATaskOfADeadRobotToAnotherOne) {
  Hall hall(2);
  const std::uint64_t task = hall.world.send("", at(hall.world, 5, 0));
  for (int i = 0; i < 12; ++i) hall.world.tick();
  const std::string first = hall.world.tasks_->robotOf(task);
  ASSERT_FALSE(first.empty());
  hall.world.die(first, false);
  ASSERT_TRUE(hall.world.runUntilDone(900));
  EXPECT_EQ(hall.world.ends_[task].end, TaskEnd::kArrived);
  EXPECT_NE(hall.world.ends_[task].robot, first);
}

TEST(RollingFleet, SaysWhyATaskCannotBeDone) {
  const auto grid = test::gridFromAscii({"....#..", "....#..", "....#.."});
  RollingWorld world(grid, {0, 2, grid->vertexAt({1, 1})}, rollingOptions(), 3);
  world.tick();
  world.die("r1", false);
  world.die("r2", true);
  const std::uint64_t cut_off = world.send("r0", grid->vertexAt({6, 0}));
  const std::uint64_t nobody = world.send("", grid->vertexAt({6, 1}));
  const std::uint64_t fault = world.send("r1", 0);
  const std::uint64_t silent = world.send("r2", 0);
  const std::uint64_t ghost = world.send("ghost", 0);
  ASSERT_TRUE(world.runUntilDone(200));
  EXPECT_EQ(world.ends_[cut_off].end, TaskEnd::kNoWay);
  EXPECT_EQ(world.ends_[nobody].end, TaskEnd::kNoWay);
  EXPECT_EQ(world.ends_[fault].end, TaskEnd::kRobotStuck);
  EXPECT_EQ(world.ends_[silent].end, TaskEnd::kRobotLost);
  EXPECT_EQ(world.ends_[ghost].end, TaskEnd::kRobotGone);
  const std::uint64_t blocked = world.send("r0", world.fleet_->vertexOf(1));
  ASSERT_TRUE(world.runUntilDone(200));
  EXPECT_EQ(world.ends_[blocked].end, TaskEnd::kGoalBlocked);
  // The others go on.
  const std::uint64_t well = world.send("r0", grid->vertexAt({0, 2}));
  ASSERT_TRUE(world.runUntilDone(300));
  EXPECT_EQ(world.ends_[well].end, TaskEnd::kArrived);
}

TEST(RollingFleet, KeepsRobotsAtRestWhileOthersAreAsManyAsMayMove) {
  const auto grid = test::gridFromAscii(hall_rows);
  RollingWorld world(grid, firstPlaces(*grid, 6), rollingOptions(), 1, 2);
  for (int i = 0; i < 6; ++i) world.send("r" + std::to_string(i), at(world, 11 - i, 5));
  for (int i = 0; i < 1500 && !world.open_.empty(); ++i) {
    world.tick();
    ASSERT_LE(world.tasks_->active(), 2U);
  }
  EXPECT_TRUE(world.open_.empty());
}

TEST(RollingFleet, LetsATaskWaitForTheFirstRobotThatJoins) {
  const auto grid = test::gridFromAscii(hall_rows);
  RollingWorld world(grid, {}, rollingOptions(), 1);
  const std::uint64_t task = world.send("", at(world, 4, 4));
  for (int i = 0; i < 10; ++i) world.tick();
  EXPECT_EQ(world.open_.size(), 1U);
  world.bodies_.emplace_back(test::pointOf(*grid, at(world, 7, 4)), RobotMotion(), "first");
  EXPECT_EQ(world.fleet_->add("first", at(world, 7, 4), kNoVertex), "");
  ASSERT_TRUE(world.runUntilDone(300));
  EXPECT_EQ(world.ends_[task].end, TaskEnd::kArrived);
  EXPECT_EQ(world.ends_[task].robot, "first");
}

TEST(RollingFleet, SendsARobotToWhereOneStandsThatIsJoining) {
  const auto grid = test::gridFromAscii(hall_rows);
  RollingWorld world(grid, {}, rollingOptions(), 1);
  for (const auto& [id, x] : {std::pair<std::string, int>("a", 0), {"b", 5}}) {
    world.bodies_.emplace_back(test::pointOf(*grid, at(world, x, 4)), RobotMotion(), id);
    EXPECT_EQ(world.fleet_->add(id, at(world, x, 4), kNoVertex), "");
  }
  const std::uint64_t task = world.send("a", at(world, 5, 4));
  const std::uint64_t other = world.send("", at(world, 0, 4));
  ASSERT_TRUE(world.runUntilDone(600));
  EXPECT_EQ(world.ends_[task].end, TaskEnd::kArrived);
  EXPECT_EQ(world.ends_[other].end, TaskEnd::kArrived);
}

TEST(RollingFleet, TakesInARobotThatJoins) {
  Hall hall(2);
  hall.world.send("r0", at(hall.world, 11, 5));
  hall.world.bodies_.emplace_back(test::pointOf(*hall.grid, at(hall.world, 7, 4)), RobotMotion(),
                                  "late");
  EXPECT_EQ(hall.world.fleet_->add("late", at(hall.world, 7, 4), kNoVertex), "");
  for (int i = 0; i < 20; ++i) hall.world.tick();
  const std::uint64_t task = hall.world.send("late", at(hall.world, 0, 5));
  ASSERT_TRUE(hall.world.runUntilDone(600));
  EXPECT_EQ(hall.world.ends_[task].end, TaskEnd::kArrived);
}

/// 12 robots in the hall, each of which gets another task as soon as it has none.
void runBusyHall(std::uint64_t seed, std::uint32_t robots, int ticks, bool disturbed) {
  FleetOptions options = rollingOptions();
  options.release = seed % 2 == 0 ? 0.7071 : 0.5;
  options.release_ahead = 2 + static_cast<std::uint32_t>(seed % 3);
  options.budget = {2000, seed};
  Hall hall(robots, seed, options);
  RollingWorld& world = hall.world;
  world.delay_one_in_ = disturbed ? 300 : 0;
  RandomEngine engine(seed);
  std::map<std::string, int> since;
  int longest = 0;
  std::size_t arrived = 0;
  for (int i = 0; i < ticks; ++i) {
    std::set<std::string> busy;
    for (const auto& [task, what] : world.open_) busy.insert(what.first);
    for (std::uint32_t robot = 0; robot < robots; ++robot) {
      const std::string id = "r" + std::to_string(robot);
      if (world.body(id).status != DriveStatus::kOk) continue;
      if (busy.count(id) == 0) {
        since[id] = i;
        world.send(id, static_cast<Vertex>(drawBelow(engine, hall.grid->size())));
      }
      longest = std::max(longest, i - since[id]);
    }
    if (disturbed && i == ticks / 3) world.restart();
    if (disturbed && i == ticks / 2) world.die("r1", seed % 2 == 0);
    world.tick();
  }
  for (const auto& [task, ended] : world.ends_) arrived += ended.end == TaskEnd::kArrived ? 1 : 0;
  EXPECT_TRUE(world.checker_.isClear()) << "seed " << seed << ": " << world.checker_.closest();
  EXPECT_TRUE(world.troubles_.empty()) << world.troubles_.front();
  EXPECT_LT(longest, 3000) << "seed " << seed;
  EXPECT_GT(arrived, static_cast<std::size_t>(ticks) * robots / 800) << "seed " << seed;
  if (test::isLongRun()) std::cerr << seed << ": " << arrived << ", longest " << longest << '\n';
}

TEST(RollingFleet, GoesOnForEverWithoutCollisions) {
  const std::uint64_t seeds = test::draws(3, 100);
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) runBusyHall(seed, 10, 3000, false);
}

TEST(RollingFleet, GoesOnWithDelaysDeathsAndARestart) {
  const std::uint64_t seeds = test::draws(6, 300);
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) runBusyHall(seed, 10, 2000, true);
}

}  // namespace
}  // namespace split_mapf
