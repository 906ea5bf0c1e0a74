#include "split/shortest_ways.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "split_mapf/split/time_split.h"
#include "support/ascii_grid.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

void expectShortest(const Instance& instance, std::uint32_t robot, Vertex from, const Path& way) {
  ASSERT_EQ(way.size(), instance.distances(robot)(from) + 1U);
  EXPECT_EQ(way.front(), from);
  EXPECT_EQ(way.back(), instance.goal(robot));
  for (std::size_t t = 1; t < way.size(); ++t) {
    EXPECT_TRUE(instance.graph().adjacent(way[t - 1], way[t]));
  }
}

TEST(ShortestWays, AreDrawnBySeedAndRobot) {
  const Instance instance = test::generatedInstance(32, 0.1, 40);
  std::uint32_t different = 0;
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    const Path way = drawShortestWay(instance, robot, 1);
    expectShortest(instance, robot, instance.start(robot), way);
    EXPECT_EQ(drawShortestWay(instance, robot, 1), way);
    different += drawShortestWay(instance, robot, 2) != way;
  }
  EXPECT_GT(different, 30U);
}

TEST(ShortestWays, AreNotCrowdedInTheMiddle) {
  std::vector<std::string> picture(21, std::string(21, '.'));
  std::vector<std::string> goals = picture;
  picture[0][0] = goals[20][20] = 'a';
  const Instance instance = test::instanceFromAscii(picture, goals);
  std::vector<int> column(21, 0);
  constexpr int kWays = 2100;
  for (int seed = 0; seed < kWays; ++seed) {
    const Vertex half_way = drawShortestWay(instance, 0, static_cast<std::uint64_t>(seed))[20];
    ++column[static_cast<std::size_t>(instance.grid().cellOf(half_way).x)];
  }
  // With equal chances at every turn the middle would have 370 and the ends none.
  for (const int ways : column) {
    EXPECT_GT(ways, 50);
    EXPECT_LT(ways, 200);
  }
}

TEST(ShortestWays, GoOnFromWhereverARobotIs) {
  const auto grid = test::gridFromAscii({".....", ".....", "....."});
  const Instance instance = Instance::fromVertices(grid, {0}, {14});
  const Path way = drawShortestWay(instance, 0, 7);
  const HeldDistances distances = instance.distances(0);
  ShortestWays ways(instance.graph(), {way});
  RandomEngine engine(3);
  EXPECT_EQ(ways.after(0, *distances, 0, 2, engine), way[2]);
  EXPECT_EQ(ways.after(0, *distances, way[2], 3, engine), way[5]) << "the same way, further on";
  // From cells beside the way, too.
  for (Vertex v = 0; v < grid->size(); ++v) {
    const std::uint32_t left = distances(v);
    for (std::uint32_t steps = 0; steps <= left; ++steps) {
      EXPECT_EQ(distances(ways.after(0, *distances, v, steps, engine)), left - steps);
    }
    EXPECT_EQ(ways.after(0, *distances, v, 0, engine), v);
  }
}

TEST(ShortestWays, LeadElsewhereOnceForgotten) {
  const Instance instance = test::generatedInstance(32, 0, 1);
  const std::uint32_t half = instance.shortestLength(0) / 2;
  const HeldDistances distances = instance.distances(0);
  ShortestWays ways(instance.graph(), {drawShortestWay(instance, 0, 0)});
  RandomEngine engine(0);
  std::set<Vertex> met;
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(ways.after(0, *distances, instance.start(0), half, engine),
              ways.after(0, *distances, instance.start(0), half, engine));
    met.insert(ways.after(0, *distances, instance.start(0), half, engine));
    ways.forget();
  }
  EXPECT_GT(met.size(), 3U);
}

}  // namespace
}  // namespace split_mapf
