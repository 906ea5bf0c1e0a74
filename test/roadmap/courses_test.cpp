#include "split_mapf/roadmap/courses.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

namespace split_mapf {
namespace {

constexpr double kRadiusM = 0.3;

ObstacleRaster openMap() { return rasterOf(200, 200, std::vector<bool>(40000, true), 0.05); }

Roadmap graphOn(const ObstacleRaster& map) {
  RoadmapOptions options;
  options.robot_radius_m = kRadiusM;
  return *buildRoadmap(map, options);
}

TEST(Courses, LeadFromPoseAlongThePathToPose) {
  const ObstacleRaster map = openMap();
  const Roadmap graph = graphOn(map);
  const std::vector<RobotPoses> robots = {{{1.05, 1.1}, {1.9, 1.02}}};
  const Attachment attachment = attachRobots(map, graph, robots);
  ASSERT_TRUE(attachment.faults.empty()) << attachment.faults.front().message;
  ASSERT_EQ(attachment.departure.steps, 1U);
  ASSERT_EQ(attachment.arrival.steps, 1U);
  const Plan plan{{{attachment.departure.vertices[0], attachment.arrival.vertices[0]}}};
  const std::vector<Course> courses = coursesOf(graph, robots, attachment, plan);
  ASSERT_EQ(courses[0].size(), 4U);  // pose, two vertices, pose
  EXPECT_DOUBLE_EQ(courses[0].front().x, 1.05);
  EXPECT_DOUBLE_EQ(courses[0].back().x, 1.9);
  EXPECT_DOUBLE_EQ(courses[0].back().y, 1.02);
  EXPECT_EQ(findMeeting(map, graph, courses), std::nullopt);
}

TEST(Courses, AMeetingNamesRobotsStepAndNeed) {
  const ObstacleRaster map = openMap();
  const Roadmap graph = graphOn(map);
  EXPECT_EQ(findMeeting(map, graph, {{{1, 1}, {2, 1}}, {{1, 2}, {2, 2}}}), std::nullopt);
  EXPECT_EQ(findMeeting(map, graph, {{{1, 1}, {3, 1}}, {{3, 3}, {3, 3}, {3, 1.5}}}),
            "robots 0 and 1 come within 0.5 m in step 2, 0.6 m are needed");
}

TEST(Courses, ARobotThatBeginsAtAWallMayLeaveItButComeNoNearer) {
  const ObstacleRaster map = openMap();
  const Roadmap graph = graphOn(map);
  EXPECT_EQ(findMeeting(map, graph, {{{0.15, 5}, {1, 5}}}), std::nullopt);
  const auto nearer = findMeeting(map, graph, {{{0.15, 5}, {0.1, 5}, {1, 5}}});
  ASSERT_TRUE(nearer.has_value());
  EXPECT_EQ(*nearer,
            "robot 0 comes within 0.1 m of the border of the map in step 1, 0.15 m are needed");
  EXPECT_NE(findMeeting(map, graph, {{{0.15, 5}, {1, 5}, {0.2, 5}}}), std::nullopt)
      << "once away it has to stay away";
}

}  // namespace
}  // namespace split_mapf
