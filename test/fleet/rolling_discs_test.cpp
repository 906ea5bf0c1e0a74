// Rolling fleets of robots that have size, on planning graphs of drawn buildings: tasks come one by
// one, robots are late and die. The checker in continuous time knows nothing of plans.

#include <memory>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "fleet/crossing.h"
#include "fleet/drawn_ground.h"
#include "fleet/rolling_world.h"
#include "support/long_run.h"

namespace split_mapf {
namespace {

using test::Crossing;
using test::drawGround;
using test::FleetWorld;
using test::Ground;
using test::RollingWorld;

FleetOptions optionsOn(const Ground& ground, std::uint64_t seed) {
  FleetOptions options = test::rollingOptions();
  options.moves = ground.moves;
  options.release_ahead = 2 + static_cast<std::uint32_t>(seed % 3);
  options.budget = {2000, seed};
  return options;
}

std::vector<Vertex> somePlaces(const Ground& ground, std::uint32_t robots, RandomEngine& engine) {
  std::vector<Vertex> all;
  for (Vertex v = 0; v < ground.grid->size(); ++v) all.push_back(v);
  for (std::uint32_t i = 0; i < robots; ++i) {
    std::swap(all[i], all[i + drawBelow(engine, all.size() - i)]);
  }
  all.resize(robots);
  return all;
}

/// Each robot gets another task as soon as it has none.
void runBusyBuilding(std::uint64_t seed, int ticks, bool disturbed) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  const Ground ground = drawGround(seed);
  RandomEngine engine(seed);
  const std::uint32_t robots = std::max(2U, ground.grid->size() / 4);
  RollingWorld world(ground.grid, somePlaces(ground, robots, engine), optionsOn(ground, seed), seed,
                     0, test::distanceOn(ground));
  world.delay_one_in_ = disturbed ? 300 : 0;
  for (int i = 0; i < ticks; ++i) {
    std::set<std::string> busy;
    for (const auto& [task, what] : world.open_) busy.insert(what.first);
    for (const RollingWorld::Body& body : world.bodies_) {
      if (body.status != DriveStatus::kOk || busy.count(body.id) > 0) continue;
      world.send(body.id, static_cast<Vertex>(drawBelow(engine, ground.grid->size())));
    }
    if (disturbed && i == ticks / 3) world.restart();
    if (disturbed && i == ticks / 2) world.die("r1", seed % 2 == 0);
    world.tick();
  }
  std::size_t arrived = 0;
  for (const auto& [task, ended] : world.ends_) arrived += ended.end == TaskEnd::kArrived ? 1 : 0;
  EXPECT_TRUE(world.checker_.isClear()) << world.checker_.closest();
  EXPECT_TRUE(world.troubles_.empty()) << world.troubles_.front();
  EXPECT_GT(arrived, static_cast<std::size_t>(ticks) * robots / 1000);
}

TEST(RollingDiscs, GoOnForEverWithoutCollisions) {
  const std::uint64_t seeds = test::draws(4, 60);
  for (std::uint64_t seed = 0; seed < seeds; ++seed) runBusyBuilding(seed, 1000, false);
}

TEST(RollingDiscs, GoOnWithDelaysDeathsAndARestart) {
  const std::uint64_t seeds = test::draws(6, 200);
  for (std::uint64_t seed = 0; seed < seeds; ++seed) runBusyBuilding(seed, 1500, true);
}

/// It waited for the dead for ever.
TEST(RollingDiscs, LeadARobotAroundOneThatDiedOnACrossing) {
  const Crossing crossing;
  FleetOptions options = test::rollingOptions();
  options.moves = crossing.moves;
  RollingWorld world(crossing.grid, {Crossing::kWest, Crossing::kSouth}, options, 1, 0,
                     Crossing::kDistanceM);
  world.send("r0", Crossing::kEast);
  const auto is_under_way = [&] { return world.fleet_->graph().progress(0) > 0.2; };
  for (int i = 0; i < 100 && !is_under_way(); ++i) world.tick();
  ASSERT_TRUE(is_under_way());
  world.die("r0", false);
  const std::uint64_t task = world.send("r1", Crossing::kNorth);
  ASSERT_TRUE(world.runUntilDone(600));
  EXPECT_EQ(world.ends_[task].end, TaskEnd::kArrived);
  EXPECT_TRUE(world.checker_.isClear()) << world.checker_.closest();
}

/// The same of robots that carry out a plan.
TEST(DiscFleet, LeadsARobotAroundOneThatDiedOnACrossing) {
  const Crossing crossing;
  FleetOptions options;
  options.moves = crossing.moves;
  options.progress_timeout_sec = 3;
  Plan plan;
  plan.paths = {{Crossing::kWest, Crossing::kEast},
                {Crossing::kSouth, Crossing::kSouth, Crossing::kNorth}};
  FleetWorld world(crossing.grid, plan, options, 1, Crossing::kDistanceM);
  const auto is_under_way = [&] { return world.fleet_->graph().progress(0) > 0.2; };
  for (int i = 0; i < 100 && !is_under_way(); ++i) world.tick();
  ASSERT_TRUE(is_under_way());
  world.die("r0", false);
  ASSERT_TRUE(world.run(600)) << world.fleet_->trouble();
  EXPECT_EQ(world.fleet_->vertexOf(1), Crossing::kNorth);
  EXPECT_TRUE(world.checker_.isClear()) << world.checker_.closest();
}

}  // namespace
}  // namespace split_mapf
