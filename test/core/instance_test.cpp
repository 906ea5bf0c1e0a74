#include "split_mapf/core/instance.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "split_mapf/core/error.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

using test::gridFromAscii;
using test::instanceFromAscii;

/// What building the instance complains about.
std::vector<InstanceFault> faultsOf(const std::vector<Cell>& starts,
                                    const std::vector<Cell>& goals) {
  try {
    Instance(gridFromAscii({"...",  //
                            ".#.",  //
                            "..."}),
             starts, goals);
  } catch (const InstanceError& e) {
    return e.faults();
  }
  return {};
}

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Instance, KeepsTheOrderOfRobots) {
  const Instance instance = instanceFromAscii({"a.b"}, {"b.a"});
  ASSERT_EQ(instance.robots(), 2U);
  EXPECT_EQ(instance.grid().cellOf(instance.start(0)), (Cell{0, 0}));
  EXPECT_EQ(instance.grid().cellOf(instance.goal(0)), (Cell{2, 0}));
  EXPECT_EQ(instance.shortestLength(1), 2U);
}

TEST(Instance, NamesRobotAndCellOfABlockedStart) {
  const auto faults = faultsOf({{0, 0}, {1, 1}}, {{2, 2}, {0, 2}});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].robot, 1U);
  EXPECT_EQ(faults[0].kind, FaultKind::kBlockedCell);
  EXPECT_TRUE(mentions(faults[0].message, "robot 1")) << faults[0].message;
  EXPECT_TRUE(mentions(faults[0].message, "start (1,1)")) << faults[0].message;
}

TEST(Instance, NamesRobotCellAndMapOfAGoalOutside) {
  const auto faults = faultsOf({{0, 0}}, {{3, 0}});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].kind, FaultKind::kOutsideMap);
  EXPECT_TRUE(mentions(faults[0].message, "goal (3,0)")) << faults[0].message;
  EXPECT_TRUE(mentions(faults[0].message, "3x3")) << faults[0].message;
  EXPECT_EQ(faultsOf({{-1, 0}}, {{0, 0}})[0].kind, FaultKind::kOutsideMap);
}

TEST(Instance, ListsEveryFaultAtOnceInTheOrderOfRobots) {
  const auto faults = faultsOf({{0, 0}, {0, 0}, {1, 1}}, {{2, 2}, {5, 5}, {2, 2}});
  ASSERT_EQ(faults.size(), 4U);
  EXPECT_EQ(faults[0].robot, 1U);
  EXPECT_EQ(faults[0].kind, FaultKind::kOutsideMap);
  EXPECT_EQ(faults[1].robot, 1U);
  EXPECT_EQ(faults[1].kind, FaultKind::kDuplicateStart);
  EXPECT_TRUE(mentions(faults[1].message, "robot 0")) << faults[1].message;
  EXPECT_EQ(faults[2].robot, 2U);
  EXPECT_EQ(faults[2].kind, FaultKind::kBlockedCell);
  EXPECT_EQ(faults[3].robot, 2U);
  EXPECT_EQ(faults[3].kind, FaultKind::kDuplicateGoal);
}

TEST(Instance, RefusesNoRobotsAndUnequalLists) {
  EXPECT_THROW(Instance(gridFromAscii({"."}), {}, {}), InputError);
  EXPECT_THROW(Instance(gridFromAscii({".."}), {{0, 0}}, {{0, 0}, {1, 0}}), InputError);
}

TEST(Instance, AStartMayBeAnotherRobotsGoal) {
  EXPECT_TRUE(faultsOf({{0, 0}, {1, 0}}, {{1, 0}, {0, 0}}).empty());
}

TEST(Instance, ACutOffRobotIsWellPosedAndFound) {
  const Instance instance = instanceFromAscii({"a.#b"}, {".a#b"});
  EXPECT_FALSE(findCutOffRobot(instance));
  const Instance cut = instanceFromAscii({"a.#b"}, {"ab#."});
  ASSERT_TRUE(findCutOffRobot(cut));
  EXPECT_EQ(*findCutOffRobot(cut), 1U);
}

TEST(Instance, LowerBoundsComeFromShortestPaths) {
  const Instance instance = instanceFromAscii({"a..b",  //
                                               "c..."},
                                              {"...a",  //
                                               "cb.."});
  EXPECT_EQ(makespanLowerBound(instance), 3U);
  EXPECT_EQ(sumOfCostsLowerBound(instance), 6U);
}

TEST(Instance, CopiesShareDistanceTables) {
  const Instance instance = instanceFromAscii({"a.."}, {"..a"});
  const Instance copy = instance;  // NOLINT(performance-unnecessary-copy-initialization)
  const HeldDistances own = instance.distances(0);
  const HeldDistances copied = copy.distances(0);
  EXPECT_EQ(&*own, &*copied);
}

TEST(Instance, FromVerticesEqualsFromCells) {
  const auto grid = gridFromAscii({".#.."});
  const Instance instance = Instance::fromVertices(grid, {0, 1}, {0, 2});
  EXPECT_EQ(grid->cellOf(instance.goal(1)), (Cell{3, 0}));
  EXPECT_THROW(Instance::fromVertices(grid, {1, 1}, {0, 2}), InstanceError);
}

TEST(Instance, NamesVerticesThatTheGridDoesNotHave) {
  const auto grid = test::gridFromAscii({"..."});
  try {
    Instance::fromVertices(grid, {0, 7}, {kNoVertex, 1});
    FAIL();
  } catch (const InstanceError& error) {
    ASSERT_EQ(error.faults().size(), 2U);
    EXPECT_EQ(error.faults()[0].message,
              "robot 0: its goal is vertex 4294967295, but the grid has 3 vertices");
    EXPECT_EQ(error.faults()[1].message,
              "robot 1: its start is vertex 7, but the grid has 3 vertices");
  }
}

TEST(Instance, TakesTablesThatStandAlready) {
  const auto grid = test::gridFromAscii({"...."});
  const auto table = std::make_shared<const DistanceTable>(grid->graph(), 3);
  const Instance instance(Problem{grid, {0, 1}, {2, 3}}, DistanceExtent::kOnDemand,
                          {nullptr, table});
  const HeldDistances distances = instance.distances(1);
  EXPECT_EQ(&*distances, table.get());
  EXPECT_EQ(instance.shortestLength(0), 2U);
}

TEST(Instance, AStretchKeepsTheTableOfWhoIsHomeAtItsEnd) {
  const auto grid = gridFromAscii({".....", ".###.", "....."});
  const Instance whole = Instance::fromVertices(grid, {0, 7}, {4, 11});
  const Instance stretch = Instance::stretchOf(whole, {1, 7}, {3, 11});
  EXPECT_EQ(stretch.start(0), 1U);
  EXPECT_EQ(stretch.goal(0), 3U);
  EXPECT_EQ(stretch.shortestLength(0), 2U);
  EXPECT_EQ(stretch.distances(0)(7), 5U) << "as exact as any, however far away";
  EXPECT_FALSE(stretch.hasShareableDistances(0));
  const HeldDistances of_stretch = stretch.distances(1);
  const HeldDistances of_whole = whole.distances(1);
  EXPECT_EQ(&*of_stretch, &*of_whole);
}

TEST(InstanceError, CountsFurtherFaults) {
  const InstanceError error(
      {{0, FaultKind::kOutsideMap, "first"}, {1, FaultKind::kOutsideMap, "second"}});
  EXPECT_EQ(std::string(error.what()).rfind("first", 0), 0U);
  EXPECT_TRUE(mentions(error.what(), "1 more"));
}

TEST(Instance, RefusesAProblemWithoutGridAndTablesOfOthers) {
  EXPECT_THROW(Instance(Problem{nullptr, {0}, {0}}), InputError);
  const auto grid = std::make_shared<const Grid>(2, 1, std::vector<bool>{true, true});
  EXPECT_THROW(Instance(Problem{grid, {0}, {1}}, DistanceExtent::kAll, {nullptr, nullptr}),
               InputError);
}

}  // namespace
}  // namespace split_mapf
