// Large fleets: a robot dies in the crowd, and all others who still have a way arrive.

#include <algorithm>
#include <iostream>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "fleet/fleet_world.h"
#include "split_mapf/generate/generator.h"
#include "support/long_run.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

using test::FleetWorld;

GeneratorOptions crowdOf(std::uint32_t width, std::uint32_t height, std::uint32_t robots) {
  GeneratorOptions options;
  options.kind = MapKind::kWarehouse;
  options.width = width;
  options.height = height;
  options.robots = robots;
  options.seed = 1;
  return options;
}

/// What plans made anew took [s].
struct Took {
  std::vector<double> cpu;
  std::vector<double> wall;
};

void tell(const char* what, std::vector<double> took) {
  std::sort(took.begin(), took.end());
  std::cout << took.size() << " plans made anew: median " << took[took.size() / 2] << " s of "
            << what << ", worst " << took.back() << " s" << std::endl;
}

/// Robots are named by their number in the plan.
std::uint32_t robotOf(const std::string& id) {
  return static_cast<std::uint32_t>(std::stoul(id.substr(1)));
}

/// Where a robot may be: what it was given leave for.
std::set<Vertex> cellsOf(const FleetWorld& world, const std::string& id) {
  const std::uint32_t robot = *world.fleet_->find(id);
  const std::uint32_t last = world.fleet_->status(world.now_)[robot].released_until;
  const FleetSnapshot kept = world.fleet_->snapshot(world.now_);
  std::set<Vertex> cells;
  for (const FleetSnapshot::Visit& visit : kept.robots[robot].visits) {
    if (visit.sequence <= last) cells.insert(world.grid_->vertexAt(visit.cell));
  }
  return cells;
}

/// One draw: who dies, and when.
void expectAllOthersArrive(const Instance& instance, const Plan& plan, std::uint64_t draw,
                           Took& took) {
  SCOPED_TRACE("draw " + std::to_string(draw));
  FleetOptions options;
  options.replan_period_sec = instance.robots() > 500 ? 60 : 5;
  options.budget.seed = draw;
  FleetWorld world(instance.sharedGrid(), plan, options, draw);
  world.request_.straighten = true;
  world.delay_one_in_ = 2000;
  const int when = 20 + static_cast<int>(drawBelow(world.engine_, 300));
  for (int i = 0; i < when; ++i) world.tick();
  const std::size_t before = world.anew_sec_.size();
  const std::string victim = "r" + std::to_string(drawBelow(world.engine_, instance.robots()));
  world.die(victim, draw % 2 == 0);
  ASSERT_TRUE(world.run(20000)) << world.fleet_->trouble();
  EXPECT_TRUE(world.checker_.isClear()) << world.checker_.closest();
  EXPECT_EQ(world.fleet_->trouble(), "");
  const std::set<Vertex> taken = cellsOf(world, victim);
  const std::vector<FleetRobotStatus> all = world.fleet_->status(world.now_);
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    const std::string& id = world.fleet_->id(i);
    if (id == victim) continue;
    EXPECT_EQ(all[i].absence, Absence::kNone) << id;
    const bool is_taken = taken.count(instance.goal(robotOf(id))) > 0;
    EXPECT_EQ(all[i].fault, is_taken ? GoalFault::kBlocked : GoalFault::kNone) << id;
    EXPECT_EQ(all[i].arrived, !is_taken) << id;
  }
  took.cpu.insert(took.cpu.end(), world.anew_sec_.begin() + before, world.anew_sec_.end());
  took.wall.insert(took.wall.end(), world.anew_wall_sec_.begin() + before,
                   world.anew_wall_sec_.end());
}

TEST(FleetCrowd, GoesOnWithoutARobotThatDies) {
  const bool is_long = test::isLongRun();
  const Instance instance =
      test::generatedInstance(is_long ? crowdOf(161, 63, 1000) : crowdOf(48, 24, 100));
  Executor executor(2);
  const Planner planner(builtinSolvers(), executor);
  PlanRequest request;
  request.objective = Objective::kSumOfCosts;
  const PlanReport report = planner.plan(instance, request, {});
  ASSERT_TRUE(report.plan) << report.message;
  Took took;
  for (std::uint64_t draw = 0; draw < (is_long ? 20U : 2U); ++draw) {
    expectAllOthersArrive(instance, *report.plan, draw, took);
  }
  ASSERT_FALSE(took.cpu.empty());
  tell("CPU", took.cpu);
  tell("wall time", took.wall);
}

}  // namespace
}  // namespace split_mapf
