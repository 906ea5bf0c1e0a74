#include "pipeline/mended_rest.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fleet/fleet_goals.h"
#include "split_mapf/core/random.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/fleet/fleet_replan.h"
#include "support/ascii_grid.h"
#include "support/random_plan.h"

namespace split_mapf {
namespace {

/// A plan on a map of which some cells are closed.
struct Scene {
  Scene(const std::vector<std::string>& rows, Plan some, const std::vector<Vertex>& closed)
      : plan(std::move(some)), whole(test::gridFromAscii(rows)), blocked(whole->size(), false) {
    for (const Vertex v : closed) blocked[v] = true;
  }
  Instance instance() const {
    std::vector<Vertex> starts;
    std::vector<Vertex> goals;
    for (const Path& path : plan.paths) {
      starts.push_back(path.front());
      goals.push_back(path.back());
    }
    return Instance::fromVertices(openPart(whole, blocked), starts, goals);
  }
  Plan plan;
  std::shared_ptr<const Grid> whole;
  std::vector<bool> blocked;
};

TEST(MendedRest, LeavesOthersTheirWays) {
  const Scene scene({"....", "....", "...."}, {{{0, 1, 2, 3}, {8, 9, 10, 11}}}, {2});
  const Instance instance = scene.instance();
  const std::vector<std::uint32_t> diverted = findDiverted(instance, scene.plan);
  ASSERT_EQ(diverted, std::vector<std::uint32_t>{0});
  const std::optional<Plan> mended = mendRest(instance, scene.plan, diverted, 0, {});
  ASSERT_TRUE(mended);
  EXPECT_EQ(mended->paths[1], scene.plan.paths[1]);
  EXPECT_EQ(mended->paths[0].size(), 6U);
  EXPECT_TRUE(validate(instance, *mended).empty());
}

TEST(MendedRest, MovesThoseInTheOnlyWayThatIsLeft) {
  // Robot 0 has to go through the lower row, where robot 1 stands at its goal.
  const Scene scene({"...", "...", "#.#"}, {{{0, 1, 2}, {4}}}, {1});
  const Instance instance = scene.instance();
  const std::optional<Plan> mended = mendRest(instance, scene.plan, {0}, 0, {});
  ASSERT_TRUE(mended);
  EXPECT_TRUE(validate(instance, *mended).empty());
  EXPECT_GT(mended->paths[1].size(), 1U);
}

TEST(MendedRest, GivesUpWhereThereIsNoWay) {
  const Scene scene({"..."}, {{{0, 1, 2}, {1}}}, {});
  const Instance instance = Instance::fromVertices(scene.whole, {0, 1}, {2, 1});
  EXPECT_FALSE(mendRest(instance, Plan{{{0}, {1}}}, {0}, 0, {}));
}

TEST(MendedRest, IsValidWheneverItIsFound) {
  std::uint32_t found = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    const auto grid =
        test::gridFromAscii({"........", ".##..##.", "........", ".##..##.", "........"});
    const Plan plan = test::randomValidPlan(*grid, 8, 12, engine);
    std::vector<bool> blocked(grid->size(), false);
    for (int i = 0; i < 3; ++i) blocked[drawBelow(engine, grid->size())] = true;
    std::vector<Vertex> starts;
    std::vector<Vertex> wanted;
    for (const Path& path : plan.paths) {
      starts.push_back(path.front());
      wanted.push_back(path.back());
      blocked[path.front()] = false;
    }
    const auto open = openPart(grid, blocked);
    const FleetGoals chosen =
        chooseGoals(*open, blocked, starts, wanted, std::vector<bool>(8, true),
                    std::vector<GoalFault>(8, GoalFault::kNone));
    const Instance instance = Instance::fromVertices(open, starts, chosen.goals);
    const std::vector<std::uint32_t> diverted = findDiverted(instance, plan);
    const std::optional<Plan> mended = mendRest(instance, plan, diverted, seed, {});
    if (!mended) continue;
    ++found;
    EXPECT_TRUE(validate(instance, *mended).empty());
  }
  EXPECT_GT(found, 250U);
}

}  // namespace
}  // namespace split_mapf
