#include "split_mapf/roadmap/roadmap.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include "split_mapf/core/error.h"
#include "split_mapf/core/random.h"
#include "split_mapf/roadmap/proof.h"
#include "split_mapf/roadmap/reach.h"
#include "support/course_checker.h"
#include "support/drawn_rooms.h"

namespace split_mapf {
namespace {

using test::DrawnRooms;
using test::drawRooms;

RoadmapOptions discsOf(double radius_m, double clearance_m = 0) {
  RoadmapOptions options;
  options.robot_radius_m = radius_m;
  options.clearance_m = clearance_m;
  return options;
}

std::string messageOf(const ObstacleRaster& raster, const RoadmapOptions& options) {
  try {
    buildRoadmap(raster, options);
  } catch (const OptionError& e) {
    return e.what();
  }
  return "";
}

ObstacleRaster openMap(std::uint32_t side) {
  return rasterOf(side, side, std::vector<bool>(std::size_t{side} * side, true), 0.05);
}

TEST(Roadmap, PassesDoorsOneCellWiderThanTheRobotWhereverTheyLie) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    // 0.25, 0.3, 0.33 or 0.35 m on cells of 0.05 m, with or without clearance.
    const double radius = std::vector<double>{0.25, 0.3, 0.33, 0.35}[seed % 4];
    const double clearance = seed % 3 == 0 ? 0.02 : 0;
    const RoadmapOptions options = discsOf(radius, clearance);
    const auto door =
        static_cast<std::uint32_t>(std::ceil(2 * (radius + clearance) / 0.05 + 1 - 1e-9));
    const std::uint32_t spacing = leastSpacingCells(options, 0.05);
    const DrawnRooms drawn = drawRooms(seed, door, 3 * spacing, 0.05);
    const auto roadmap = buildRoadmap(drawn.raster, options);
    ASSERT_TRUE(roadmap.has_value());
    const auto reach = measureReach(drawn.raster, *roadmap);
    ASSERT_TRUE(reach.has_value());
    EXPECT_EQ(reach->rooms, drawn.columns * drawn.rows) << "seed " << seed;
    EXPECT_EQ(reach->rooms_lost, 0U) << "seed " << seed;
    EXPECT_GT(reach->share(), 0.97) << "seed " << seed;
    EXPECT_LE(roadmap->longest_edge_m, 1.75 * spacing * 0.05 + 1e-9) << "seed " << seed;
  }
}

/// Robots that go where chance leads them, as far as the rules let them: behind each other and
/// round in rings, too, but never two to one vertex and never past each other along an edge.
class Wanderers {
 public:
  Wanderers(const Grid& grid, std::uint64_t seed) : grid_(grid), engine_(seed) {
    for (Vertex v = 0; v < grid.size(); ++v) {
      if (drawBelow(engine_, 3) == 0) at_.push_back(v);
    }
  }

  const std::vector<Vertex>& positions() const { return at_; }

  void step() {
    std::vector<std::size_t> robot_at(grid_.size(), at_.size());
    for (std::size_t i = 0; i < at_.size(); ++i) robot_at[at_[i]] = i;
    std::vector<Vertex> next = at_;
    for (std::size_t i = 0; i < at_.size(); ++i) {
      const VertexRange ways = grid_.graph().neighbours(at_[i]);
      if (ways.size() == 0 || drawBelow(engine_, 4) == 0) continue;
      next[i] = *(ways.begin() + drawBelow(engine_, ways.size()));
    }
    while (holdOneBack(robot_at, next)) continue;
    at_ = next;
  }

 private:
  /// Lets the first robot stay that may not go. @return whether there was one
  bool holdOneBack(const std::vector<std::size_t>& robot_at, std::vector<Vertex>& next) const {
    std::vector<std::size_t> claims(grid_.size(), 0);
    for (const Vertex v : next) ++claims[v];
    for (std::size_t i = 0; i < at_.size(); ++i) {
      if (next[i] == at_[i]) continue;
      const std::size_t other = robot_at[next[i]];
      if (claims[next[i]] == 1 && (other == at_.size() || next[other] != at_[i])) continue;
      next[i] = at_[i];
      return true;
    }
    return false;
  }

  const Grid& grid_;
  RandomEngine engine_;
  std::vector<Vertex> at_;
};

TEST(Roadmap, DiscsThatWanderByTheRulesNeverMeet) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const DrawnRooms drawn = drawRooms(seed, 15, 60, 0.05);
    const auto roadmap = buildRoadmap(drawn.raster, discsOf(0.3, 0.03));
    ASSERT_TRUE(roadmap.has_value());
    const auto grid = gridOf(*roadmap);
    Wanderers wanderers(*grid, seed);
    std::vector<test::DiscCourse> courses(wanderers.positions().size());
    for (int step = 0; step < 60; ++step, wanderers.step()) {
      for (std::size_t i = 0; i < courses.size(); ++i) {
        const Cell cell = grid->cellOf(wanderers.positions()[i]);
        courses[i].x.push_back((cell.x + 0.5) * 0.05);
        courses[i].y.push_back((cell.y + 0.5) * 0.05);
      }
    }
    const test::DiscWorld world{
        drawn.raster.width, drawn.raster.height, 0.05, drawn.raster.blocked, 0.33, 0.63};
    const auto collision = findDiscCollision(world, courses);
    EXPECT_EQ(collision, std::nullopt) << "seed " << seed << ": " << *collision;
  }
}

TEST(Roadmap, TheDiscCheckerFindsATurnThatIsTooTight) {
  const test::DiscWorld world{
      100, 100, 0.1, std::vector<std::uint8_t>(10000, 0), /*wall_gap=*/0.5, /*disc_gap=*/1};
  const auto turning = [&world](double edge) {
    return findDiscCollision(world,
                             {{{4, 4}, {4, 4 + edge}}, {{4, 4 + edge}, {4 + edge, 4 + edge}}});
  };
  EXPECT_TRUE(turning(1.40).has_value());
  EXPECT_FALSE(turning(1.42).has_value());
  EXPECT_TRUE(findDiscCollision(world, {{{4, 0.4}, {4, 4}}}).has_value());
}

TEST(Roadmap, RobotsWithoutSizeGetTheGridItself) {
  const DrawnRooms drawn = drawRooms(1, 3, 12, 0.05);
  const Grid grid(drawn.raster.width, drawn.raster.height, freeCells(drawn.raster));
  const auto roadmap = buildRoadmap(drawn.raster, discsOf(0));
  ASSERT_TRUE(roadmap.has_value());
  const auto planning = gridOf(*roadmap);
  ASSERT_EQ(planning->size(), grid.size());
  ASSERT_EQ(planning->graph().edgeCount(), grid.graph().edgeCount());
  for (Vertex v = 0; v < grid.size(); ++v) ASSERT_EQ(planning->cellOf(v), grid.cellOf(v));
}

TEST(Roadmap, IsTheSameEveryTime) {
  const DrawnRooms drawn = drawRooms(9, 16, 60, 0.05);
  const auto first = buildRoadmap(drawn.raster, discsOf(0.35));
  const auto second = buildRoadmap(drawn.raster, discsOf(0.35));
  EXPECT_EQ(first->cells, second->cells);
  EXPECT_EQ(first->edges, second->edges);
}

TEST(Roadmap, ALargerCellSizeSpreadsTheLattice) {
  RoadmapOptions options = discsOf(0.25);
  EXPECT_EQ(leastSpacingCells(options, 0.05), 15U);
  options.cell_size_m = 0.98;
  options.passages = false;
  const auto roadmap = buildRoadmap(openMap(200), options);
  ASSERT_TRUE(roadmap.has_value());
  EXPECT_EQ(roadmap->spacing_cells, 20U);
  EXPECT_DOUBLE_EQ(roadmap->longest_edge_m, 1.0);
}

TEST(Roadmap, BadLengthsAreRefusedWithWhatWouldDo) {
  const ObstacleRaster map = openMap(60);
  EXPECT_NE(messageOf(map, discsOf(-0.1)).find("robot_radius is -0.1"), std::string::npos);
  EXPECT_NE(messageOf(map, discsOf(std::nan(""))).find("robot_radius is nan"), std::string::npos);
  EXPECT_NE(messageOf(map, discsOf(HUGE_VAL)).find("robot_radius is inf"), std::string::npos);
  EXPECT_NE(messageOf(map, discsOf(0.2, -1)).find("clearance is -1"), std::string::npos);
  RoadmapOptions tight = discsOf(0.25);
  tight.cell_size_m = 0.5;
  EXPECT_NE(messageOf(map, tight).find("at least 0.75 m is needed"), std::string::npos)
      << messageOf(map, tight);
  // The middle of a map of 60 cells is 1.475 m from its border.
  EXPECT_NE(messageOf(map, discsOf(1.6)).find("more than 1.475 m"), std::string::npos)
      << messageOf(map, discsOf(1.6));
}

TEST(Roadmap, AMapOfOneCellHoldsASmallRobot) {
  const ObstacleRaster map = rasterOf(1, 1, {true}, 1);
  const auto roadmap = buildRoadmap(map, discsOf(0.4));
  ASSERT_TRUE(roadmap.has_value());
  EXPECT_EQ(roadmap->cells, std::vector<std::uint32_t>{0});
  EXPECT_TRUE(roadmap->edges.empty());
  EXPECT_NE(messageOf(map, discsOf(0.6)).find("0.5 m"), std::string::npos);
}

TEST(Roadmap, HearsAStopWithin200MillisecondsInEveryPass) {
  using Clock = std::chrono::steady_clock;
  const DrawnRooms drawn = drawRooms(4, 16, 400, 0.05);
  for (const int wait_ms : {0, 5, 20, 40, 60, 80, 120}) {
    const auto stop = std::make_shared<StopFlag>();
    Clock::time_point stopped;
    std::thread stopper([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
      stopped = Clock::now();
      stop->request();
    });
    const auto roadmap = buildRoadmap(drawn.raster, discsOf(0.25), Deadline(-1, stop));
    const Clock::time_point done = Clock::now();
    stopper.join();
    if (done < stopped) {
      ASSERT_TRUE(roadmap.has_value());
      continue;
    }
    EXPECT_LT(std::chrono::duration<double>(done - stopped).count(), 0.2) << wait_ms << " ms";
  }
  EXPECT_EQ(buildRoadmap(drawn.raster, discsOf(0.25), Deadline(0)), std::nullopt);
}

}  // namespace
}  // namespace split_mapf
