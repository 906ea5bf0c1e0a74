#include "split_mapf/roadmap/attachment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "split_mapf/core/random.h"
#include "support/course_checker.h"
#include "support/drawn_rooms.h"

namespace split_mapf {
namespace {

constexpr double kRadiusM = 0.3;
constexpr double kResolutionM = 0.05;

struct World {
  ObstacleRaster raster;
  Roadmap roadmap;
};

World worldOf(const ObstacleRaster& raster) {
  RoadmapOptions options;
  options.robot_radius_m = kRadiusM;
  return {raster, *buildRoadmap(raster, options)};
}

/// In the frame of the raster, turned over: y goes up.
std::string textOf(const AttachmentFault& fault) {
  std::vector<std::string> names;
  names.reserve(20);
  for (int i = 0; i < 20; ++i) names.push_back("robot " + std::to_string(i));
  return explain(fault, names, {0, 0, 0, 10});
}

World openWorld() { return worldOf(rasterOf(200, 200, std::vector<bool>(40000, true), 0.05)); }

MapPoint placeOf(const World& world, Vertex v) {
  const Cell cell = world.raster.cellAt(world.roadmap.cells[v]);
  return {(cell.x + 0.5) * kResolutionM, (cell.y + 0.5) * kResolutionM};
}

/// Whether a disc fits at `p`, all squares looked at.
bool fits(const ObstacleRaster& raster, MapPoint p, double radius) {
  if (p.x < radius || p.y < radius || p.x > raster.width * kResolutionM - radius ||
      p.y > raster.height * kResolutionM - radius) {
    return false;
  }
  for (std::size_t i = 0; i < raster.blocked.size(); ++i) {
    if (raster.blocked[i] == 0) continue;
    const Cell cell = raster.cellAt(i);
    const double dx = std::max(0.0, std::abs(p.x - (cell.x + 0.5) * kResolutionM) - 0.025);
    const double dy = std::max(0.0, std::abs(p.y - (cell.y + 0.5) * kResolutionM) - 0.025);
    if (dx * dx + dy * dy < radius * radius) return false;
  }
  return true;
}

std::vector<MapPoint> drawPoses(const ObstacleRaster& raster, std::size_t count,
                                RandomEngine& engine) {
  std::vector<MapPoint> poses;
  while (poses.size() < count) {
    const MapPoint p{
        static_cast<double>(drawBelow(engine, std::uint64_t{raster.width} * 1000)) / 20000,
        static_cast<double>(drawBelow(engine, std::uint64_t{raster.height} * 1000)) / 20000};
    const bool apart = std::all_of(poses.begin(), poses.end(), [&](MapPoint q) {
      return std::hypot(p.x - q.x, p.y - q.y) > 2 * kRadiusM + 0.02;
    });
    if (apart && fits(raster, p, kRadiusM + 1e-4)) poses.push_back(p);
  }
  return poses;
}

/// The legs as courses: away from the poses (departure), or towards them (arrival).
std::vector<test::DiscCourse> coursesOf(const World& world, const std::vector<MapPoint>& poses,
                                        const Legs& legs, bool arriving) {
  std::vector<test::DiscCourse> courses(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const MapPoint vertex = placeOf(world, legs.vertices[i]);
    for (std::uint32_t step = 0; step <= legs.steps; ++step) {
      const bool walked = step > legs.waves[i];
      const MapPoint at = walked != arriving ? vertex : poses[i];
      courses[i].x.push_back(at.x);
      courses[i].y.push_back(at.y);
    }
  }
  return courses;
}

TEST(Attachment, RandomPosesLeaveAndArriveWithoutMeeting) {
  std::size_t attached = 0;
  std::size_t robots_in_all = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const World world = worldOf(test::drawRooms(seed, 15, 60, kResolutionM).raster);
    RandomEngine engine(seed);
    const std::size_t count = 20;
    const std::vector<MapPoint> starts = drawPoses(world.raster, count, engine);
    const std::vector<MapPoint> goals = drawPoses(world.raster, count, engine);
    std::vector<RobotPoses> robots;
    for (std::size_t i = 0; i < count; ++i) robots.push_back({starts[i], goals[i]});
    robots_in_all += count;
    Attachment attachment = attachRobots(world.raster, world.roadmap, robots);
    // Poses that cannot be served are named, and the others can.
    for (int tries = 0; tries < 10 && !attachment.faults.empty(); ++tries) {
      for (std::size_t i = attachment.faults.size(); i-- > 0;) {
        const std::uint32_t robot = attachment.faults[i].robot;
        if (i > 0 && attachment.faults[i - 1].robot == robot) continue;
        robots.erase(robots.begin() + robot);
      }
      attachment = attachRobots(world.raster, world.roadmap, robots);
    }
    ASSERT_TRUE(attachment.faults.empty()) << textOf(attachment.faults.front());
    attached += robots.size();
    for (const bool arriving : {false, true}) {
      const Legs& legs = arriving ? attachment.arrival : attachment.departure;
      std::vector<MapPoint> poses;
      poses.reserve(robots.size());
      for (const RobotPoses& robot : robots) poses.push_back(arriving ? robot.goal : robot.start);
      EXPECT_EQ(std::set<Vertex>(legs.vertices.begin(), legs.vertices.end()).size(), poses.size());
      const auto collision =
          findDiscCollision({world.raster.width, world.raster.height, kResolutionM,
                             world.raster.blocked, kRadiusM, 2 * kRadiusM},
                            coursesOf(world, poses, legs, arriving));
      EXPECT_EQ(collision, std::nullopt) << "seed " << seed << ": " << *collision;
    }
  }
  EXPECT_GE(attached, robots_in_all * 9 / 10);
}

TEST(Attachment, TwoRobotsInWhatIsOneCellOfTheLatticeGetTwoVertices) {
  const World world = openWorld();
  const MapPoint v = placeOf(world, 40);
  const MapPoint a{v.x - 0.1, v.y};
  const MapPoint b{v.x + 0.55, v.y};
  const Attachment attachment =
      attachRobots(world.raster, world.roadmap, {{a, placeOf(world, 0)}, {b, placeOf(world, 60)}});
  ASSERT_TRUE(attachment.faults.empty()) << textOf(attachment.faults.front());
  EXPECT_NE(attachment.departure.vertices[0], attachment.departure.vertices[1]);
}

TEST(Attachment, RobotsOnTheirVerticesNeedNoSteps) {
  const World world = openWorld();
  const Attachment attachment = attachRobots(
      world.raster, world.roadmap,
      {{placeOf(world, 3), placeOf(world, 4)}, {placeOf(world, 4), placeOf(world, 3)}});
  ASSERT_TRUE(attachment.faults.empty());
  EXPECT_EQ(attachment.departure.steps, 0U);
  EXPECT_EQ(attachment.departure.vertices, (std::vector<Vertex>{3, 4}));
  EXPECT_EQ(attachment.arrival.vertices, (std::vector<Vertex>{4, 3}));
}

TEST(Attachment, AStartHalfARadiusFromAWallStillGetsAwayAndSuchAGoalIsRefused) {
  const World world = openWorld();
  const MapPoint at_wall{kRadiusM / 2, 5};
  const MapPoint free{5, 5};
  EXPECT_TRUE(attachRobots(world.raster, world.roadmap, {{at_wall, free}}).faults.empty());
  const Attachment refused = attachRobots(world.raster, world.roadmap, {{free, at_wall}});
  ASSERT_EQ(refused.faults.size(), 1U);
  EXPECT_EQ(refused.faults[0].kind, AttachmentFaultKind::kTooNearObstacle);
  EXPECT_EQ(textOf(refused.faults[0]),
            "robot 0: its goal (0.15, 5) is 0.15 m from an obstacle, 0.3 m are needed");
}

TEST(Attachment, NamesEveryRobotAtFault) {
  const World world = openWorld();
  const Attachment attachment = attachRobots(
      world.raster, world.roadmap,
      {{{5, 5}, {2, 2}}, {{5.5, 5}, {3, 3}}, {{-1, 5}, {4, 4}}, {{7, 7}, {std::nan(""), 1}}});
  ASSERT_EQ(attachment.faults.size(), 3U);
  EXPECT_EQ(attachment.faults[0].robot, 1U);
  EXPECT_EQ(attachment.faults[0].kind, AttachmentFaultKind::kDiscsOverlap);
  EXPECT_NE(textOf(attachment.faults[0]).find("0.5 m from that of robot 0, 0.6 m are needed"),
            std::string::npos)
      << textOf(attachment.faults[0]);
  EXPECT_EQ(attachment.faults[1].kind, AttachmentFaultKind::kOutsideMap);
  EXPECT_EQ(attachment.faults[2].kind, AttachmentFaultKind::kOutsideMap);
}

TEST(Attachment, SaysWhereNoEdgesLead) {
  // Two rooms without a door.
  std::vector<bool> free(std::size_t{200} * 100, true);
  for (std::size_t y = 0; y < 100; ++y) free[y * 200 + 100] = false;
  const World world = worldOf(rasterOf(200, 100, free, kResolutionM));
  const Attachment attachment = attachRobots(world.raster, world.roadmap, {{{2, 2}, {8, 2}}});
  ASSERT_EQ(attachment.faults.size(), 1U);
  EXPECT_EQ(attachment.faults[0].kind, AttachmentFaultKind::kOtherPiece);
  EXPECT_TRUE(isCutOff(attachment.faults[0]));
  EXPECT_EQ(textOf(attachment.faults[0]),
            "robot 0: its goal (8, 8) is near no vertex to which edges lead from those near its "
            "start; no free way leads from its start to its goal, however narrow");
}

/// The fault of a robot of 0.3 m between two rooms whose wall has doors of so many cells of 5 cm.
AttachmentFault faultBetweenRooms(std::size_t lower_door, std::size_t upper_door, MapPoint start) {
  std::vector<bool> free(std::size_t{200} * 200, true);
  for (std::size_t y = 0; y < 200; ++y) {
    free[y * 200 + 100] = (y >= 20 && y < 20 + lower_door) || (y >= 150 && y < 150 + upper_door);
  }
  const World world = worldOf(rasterOf(200, 200, free, kResolutionM));
  const Attachment attachment = attachRobots(world.raster, world.roadmap, {{start, {8, 2}}});
  EXPECT_EQ(attachment.faults.size(), 1U);
  return attachment.faults.empty() ? AttachmentFault() : attachment.faults.front();
}

TEST(Attachment, NamesTheBottleneckOfTheWidestWay) {
  // The graph needs 13 cells, so that a centre of a cell keeps 0.3 m.
  const std::string text = textOf(faultBetweenRooms(10, 11, {2, 2}));
  EXPECT_NE(text.find("the widest way from its start to its goal has 0.275 m to an obstacle at "
                      "(5.025, 2.225), 0.3 m needed"),
            std::string::npos)
      << text;
}

TEST(Attachment, ClaimedProofsOfDoorsThroughWhichADiscFits) {
  EXPECT_FALSE(isCutOff(faultBetweenRooms(5, 12, {2, 2}))) << "0.6 m wide, as the robot";
  EXPECT_TRUE(isCutOff(faultBetweenRooms(9, 10, {2, 2})));
  // Who begins 0.2 m from an obstacle need not keep more before there is more room.
  EXPECT_FALSE(isCutOff(faultBetweenRooms(5, 10, {0.2, 5})));
}

TEST(Attachment, ASmallRobotStandsWhereTheLargestCouldNot) {
  const World world = openWorld();
  const MapPoint corner{0.12, 0.12};
  EXPECT_FALSE(attachRobots(world.raster, world.roadmap, {{{5, 5}, corner}}).faults.empty());
  const Attachment small =
      attachRobots(world.raster, world.roadmap, {{{5, 5}, corner, 0.1}, {{3, 3}, {0.5, 0.35}}});
  EXPECT_TRUE(small.faults.empty()) << textOf(small.faults.front());
}

}  // namespace
}  // namespace split_mapf
