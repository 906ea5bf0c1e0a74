// Fleets of discs with everything that goes wrong, drawn from a seed.

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <set>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "fleet/drawn_ground.h"
#include "fleet/fleet_world.h"
#include "support/ascii_grid.h"
#include "support/long_run.h"
#include "support/random_plan.h"

namespace split_mapf {
namespace {

using test::FleetWorld;

FleetOptions optionsOf(std::uint64_t seed) {
  FleetOptions options;
  options.release = seed % 3 == 0 ? 0.7071 : 0.5;
  options.replan_period_sec = 3;
  options.progress_timeout_sec = 2;
  options.budget = {3000, seed};
  options.release_ahead = 1 + static_cast<std::uint32_t>(seed % 3);
  return options;
}

std::vector<std::vector<std::string>> maps() {
  return {
      {"........", ".##..##.", "........", ".##..##.", "........"},
      {"......", "......", "......", "......", "......"},
      {".........", ".#.#.#.#.", ".........", ".#.#.#.#.", "........."},
      {"............", ".####..####.", "............", "............", ".####..####.",
       "............"},
      {"...........", "####.#.####", "...........", "...........", "####.#.####", "..........."}};
}

struct Scene {
  std::shared_ptr<const Grid> grid;
  Plan plan;
  std::shared_ptr<const CloseMoves> moves = nullptr;
  double distance_m = 0;
};

Scene sceneOf(std::uint64_t seed) {
  RandomEngine engine(seed);
  const auto all = maps();
  Scene run;
  run.grid = test::gridFromAscii(all[seed % all.size()]);
  run.plan = test::randomValidPlan(*run.grid, 4 + static_cast<std::uint32_t>(drawBelow(engine, 6)),
                                   14, engine);
  return run;
}

/// On a planning graph of a drawn building: there plans for robots that have size are executed.
Scene planningSceneOf(std::uint64_t seed) {
  RandomEngine engine(seed);
  const test::Ground ground = test::drawGround(seed % 60);
  Scene run;
  run.grid = ground.grid;
  run.moves = ground.moves;
  run.distance_m = test::distanceOn(ground);
  const std::uint32_t most = std::max(3U, ground.grid->size() / 3);
  run.plan = test::randomValidPlan(
      *run.grid, std::min(most, 3 + static_cast<std::uint32_t>(drawBelow(engine, 7))), 14, engine);
  return run;
}

FleetOptions optionsOn(const Scene& scene, std::uint64_t seed) {
  FleetOptions options = optionsOf(seed);
  options.moves = scene.moves;
  return options;
}

/// A fleet of discs on a scene that belongs to a seed.
struct Drive {
  explicit Drive(std::uint64_t number, Scene there)
      : seed(number),
        scene(std::move(there)),
        world(scene.grid, scene.plan, optionsOn(scene, number), number, scene.distance_m) {}
  explicit Drive(std::uint64_t number) : Drive(number, sceneOf(number)) {}
  void ticks(std::uint64_t most) {
    for (std::uint64_t i = 0; i < most; ++i) world.tick();
  }
  void die(const std::string& id, bool silent) {
    world.die(id, silent);
    dead.insert(id);
  }
  /// A robot that is drawn.
  std::string someone() {
    return "r" + std::to_string(drawBelow(world.engine_, scene.plan.paths.size()));
  }
  std::vector<bool> someCells(int count) {
    std::vector<bool> cells(scene.grid->size(), false);
    for (int i = 0; i < count; ++i) cells[drawBelow(world.engine_, cells.size())] = true;
    return cells;
  }
  std::uint64_t seed;
  Scene scene;
  FleetWorld world;
  std::set<std::string> dead;
  bool closes = false;  // cells stay closed
};

/// Whoever has a way has come to its goal, nobody but the dead dropped out, and no robot was ever
/// too close.
void expectWell(Drive& run) {
  FleetWorld& world = run.world;
  ASSERT_TRUE(world.run(6000)) << world.fleet_->trouble();
  EXPECT_TRUE(world.checker_.isClear()) << world.checker_.closest();
  EXPECT_EQ(world.fleet_->trouble(), "");
  const std::vector<FleetRobotStatus> all = world.fleet_->status(world.now_);
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    if (run.dead.count(world.fleet_->id(i)) > 0) continue;
    EXPECT_EQ(all[i].absence, Absence::kNone) << world.fleet_->id(i);
    // The dead, and closed cells, may be on another one's goal or in its only way.
    if (all[i].fault != GoalFault::kNone) {
      EXPECT_TRUE(!run.dead.empty() || run.closes) << world.fleet_->id(i);
    } else {
      EXPECT_TRUE(all[i].arrived) << world.fleet_->id(i);
    }
  }
}

/// SPLIT_MAPF_FIRST_SEED, for runs that nobody has seen; 0 without it.
std::uint64_t firstSeed() {
  const char* wished = std::getenv("SPLIT_MAPF_FIRST_SEED");
  return wished != nullptr ? std::stoull(wished) : 0;
}

/// Runs what is to happen for each seed. @param more  so many times as many in a long run.
template <typename What>
void forSeeds(std::uint64_t seeds, const What& what, std::uint64_t more = 20,
              Scene (*scene)(std::uint64_t) = sceneOf) {
  const std::uint64_t all = test::draws(seeds, more * seeds);
  const std::uint64_t first = firstSeed();
  for (std::uint64_t seed = first; seed < first + all && !::testing::Test::HasFatalFailure();
       ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Drive run(seed, scene(seed));
    what(run);
  }
}

TEST(FleetRuns, BringLateRobotsToTheirGoals) {
  forSeeds(40, [](Drive& run) {
    run.world.delay_one_in_ = 150;
    expectWell(run);
    for (const ReportFate fate : run.world.fates_) ASSERT_EQ(fate, ReportFate::kTaken);
  });
}

TEST(FleetRuns, GoOnWithoutTheDead) {
  std::uint32_t anew = 0;
  forSeeds(60, [&](Drive& run) {
    FleetWorld& world = run.world;
    world.delay_one_in_ = 150;
    run.ticks(drawBelow(world.engine_, 60));
    run.die(run.someone(), run.seed % 2 == 0);
    expectWell(run);
    anew += world.anew_;
  });
  EXPECT_GT(anew, test::draws(10U));
}

/// Nobody conducts for a while, three times.
void takeUpAgain(Drive& run) {
  FleetWorld& world = run.world;
  world.delay_one_in_ = 200;
  for (int times = 0; times < 3; ++times) {
    run.ticks(drawBelow(world.engine_, 60));
    if (times == 1 && run.seed % 3 == 0) run.die("r0", true);
    world.restart();
  }
  expectWell(run);
}

TEST(FleetRuns, AreTakenUpAgainWhenTheirConductorDies) { forSeeds(60, takeUpAgain); }

TEST(FleetRuns, GoRoundWhereAllGoodPlansRotate) {
  // The dead robot closes half of the map, and three others have to let a fourth one pass.
  Drive run(945);
  takeUpAgain(run);
}

TEST(FleetRuns, KeepOffWhoDiedUnseenBehindACellToWhichItCameBack) {
  // Silent when the second conductor comes, two cells behind the one that it is known to have left.
  Drive run(701040);
  takeUpAgain(run);
}

TEST(FleetRuns, LeadAroundBlockedCellsAndPausedRobots) {
  forSeeds(40, [](Drive& run) {
    FleetWorld& world = run.world;
    run.ticks(25);
    const std::vector<bool> none(run.scene.grid->size(), false);
    world.fleet_->setBlocked(run.someCells(3));
    world.fleet_->pause(1, true);
    run.ticks(100);
    EXPECT_FALSE(world.fleet_->isFinished()) << "a robot is paused";
    world.fleet_->pause(1, false);
    world.fleet_->setBlocked(none);
    expectWell(run);
  });
}

/// What happened in runs.
struct Count {
  std::uint32_t deaths = 0;
  std::uint32_t closures = 0;
  std::uint32_t anew = 0;
  std::uint32_t runs = 0;
};

/// Robots late by up to a tenth of the time, deaths, and cells that are closed for a while or for
/// good, while robots drive.
void everythingGoesWrong(Drive& run, Count& count) {
  FleetWorld& world = run.world;
  // Each delay takes 4.5 s in the mean.
  const int one_in[] = {0, 4500, 900, 405};
  world.delay_one_in_ = one_in[drawBelow(world.engine_, 4)];
  for (std::uint64_t times = drawBelow(world.engine_, 4); times > 0; --times) {
    run.ticks(drawBelow(world.engine_, 60));
    const std::uint64_t what = drawBelow(world.engine_, 3);
    if (what == 0) run.die(run.someone(), drawBelow(world.engine_, 2) == 0);
    run.closes = what == 0 ? run.closes : what == 1;
    if (what > 0) world.fleet_->setBlocked(run.someCells(what == 1 ? 3 : 0));
    ++(what == 0 ? count.deaths : count.closures);
  }
  expectWell(run);
  count.anew += world.anew_;
  ++count.runs;
}

void show(const Count& count) {
  std::cout << count.runs << " runs, " << count.deaths << " deaths, " << count.closures
            << " changes of closed cells, " << count.anew << " plans made anew" << std::endl;
}

TEST(FleetRuns, HaveNoCollisionsAndNoDeadlocks) {
  Count count;
  forSeeds(
      50, [&](Drive& run) { everythingGoesWrong(run, count); }, 200);
  show(count);
  EXPECT_GT(count.anew, test::draws(10U));
}

TEST(FleetRuns, HaveNoCollisionsAndNoDeadlocksOnPlanningGraphs) {
  Count count;
  forSeeds(
      30, [&](Drive& run) { everythingGoesWrong(run, count); }, 60, planningSceneOf);
  show(count);
  EXPECT_GT(count.anew, test::draws(10U));
}

TEST(FleetRuns, SendARobotWithoutAWayFromWhereOthersCouldOnlyRotate) {
  // The nearest place for it lies on a square behind a lane, in which the others then cannot part.
  Count count;
  Drive run(822, planningSceneOf(822));
  everythingGoesWrong(run, count);
}

TEST(FleetRuns, GiveUpAGoalWhereTheOthersCouldOnlyRotateForGood) {
  // Cells that closed have left robots that have to change places a square and a lane to it.
  for (const std::uint64_t seed : {100551, 101751}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Count count;
    Drive run(seed, planningSceneOf(seed));
    everythingGoesWrong(run, count);
  }
}

TEST(FleetRuns, GiveUpAGoalForWhichAnotherCouldNotMakeRoom) {
  Count count;
  Drive run(300367, planningSceneOf(300367));
  everythingGoesWrong(run, count);
}

TEST(FleetRuns, GiveUpTwoGoalsOfARingWhereOneIsNotEnough) {
  // One stands between a lane and a square that is full, another one wants to the lane's end.
  Count count;
  Drive run(503099);
  everythingGoesWrong(run, count);
}

TEST(FleetRuns, AreTakenUpAgainOnPlanningGraphs) { forSeeds(20, takeUpAgain, 20, planningSceneOf); }

}  // namespace
}  // namespace split_mapf
