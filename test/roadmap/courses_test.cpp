#include "split_mapf/roadmap/courses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace split_mapf {
namespace {

constexpr double kRadiusM = 0.3;

ObstacleRaster openMap() { return rasterOf(200, 200, std::vector<bool>(40000, true), 0.05); }

Roadmap graphOn(const ObstacleRaster& map) {
  RoadmapOptions options;
  options.robot_radius_m = kRadiusM;
  return *buildRoadmap(map, options);
}

/// The first violation of discs of kRadiusM, in words.
std::optional<std::string> findMeeting(const ObstacleRaster& map,
                                       const std::vector<Course>& courses) {
  const Discs discs{std::vector<double>(courses.size(), kRadiusM), 0};
  const DiscCheck check = checkDiscs(map, discs, courses);
  if (check.violations.empty()) return std::nullopt;
  return explain(check.violations.front(), {"robot 0", "robot 1"}, {0, 0, 0, 10});
}

TEST(Courses, LeadFromPoseAlongThePathToPose) {
  const ObstacleRaster map = openMap();
  const Roadmap graph = graphOn(map);
  const std::vector<RobotPoses> robots = {{{1.05, 1.1}, {1.9, 1.02}}};
  const Attachment attachment = attachRobots(map, graph, robots);
  ASSERT_TRUE(attachment.faults.empty()) << explain(attachment.faults.front(), {"robot 0"}, {});
  ASSERT_EQ(attachment.departure.steps, 1U);
  ASSERT_EQ(attachment.arrival.steps, 1U);
  const Plan plan{{{attachment.departure.vertices[0], attachment.arrival.vertices[0]}}};
  const std::vector<Course> courses = coursesOf(graph, robots, attachment, plan);
  ASSERT_EQ(courses[0].size(), 4U);  // pose, two vertices, pose
  EXPECT_DOUBLE_EQ(courses[0].front().x, 1.05);
  EXPECT_DOUBLE_EQ(courses[0].back().x, 1.9);
  EXPECT_DOUBLE_EQ(courses[0].back().y, 1.02);
  EXPECT_EQ(findMeeting(map, courses), std::nullopt);
}

TEST(Courses, AMeetingNamesRobotsStepAndNeed) {
  const ObstacleRaster map = openMap();
  EXPECT_EQ(findMeeting(map, {{{1, 1}, {2, 1}}, {{1, 2}, {2, 2}}}), std::nullopt);
  EXPECT_EQ(
      findMeeting(map, {{{1, 1}, {3, 1}}, {{3, 3}, {3, 3}, {3, 1.5}}}),
      "robot 0 comes within 0.5 m of robot 1 in step 2, which begins at (3, 9); 0.6 m are needed");
}

TEST(Courses, ARobotThatBeginsAtAWallMayLeaveItButComeNoNearer) {
  const ObstacleRaster map = openMap();
  EXPECT_EQ(findMeeting(map, {{{0.15, 5}, {1, 5}}}), std::nullopt);
  const auto nearer = findMeeting(map, {{{0.15, 5}, {0.1, 5}, {1, 5}}});
  ASSERT_TRUE(nearer.has_value());
  EXPECT_EQ(
      *nearer,
      "robot 0 comes within 0.1 m of the border of the map in step 1, which begins at (0.15, 5); "
      "0.15 m are needed");
  EXPECT_NE(findMeeting(map, {{{0.15, 5}, {1, 5}, {0.2, 5}}}), std::nullopt)
      << "once away it has to stay away";
}

TEST(Courses, EveryRobotKeepsItsOwnRadius) {
  const ObstacleRaster map = openMap();
  const std::vector<Course> courses = {{{0.2, 5}, {0.2, 6}}, {{0.75, 5}, {0.75, 6}}};
  EXPECT_TRUE(checkDiscs(map, {{0.2, 0.3}, 0}, courses).violations.empty());
  const DiscCheck wider = checkDiscs(map, {{0.2, 0.3}, 0.1}, courses);
  ASSERT_EQ(wider.violations.size(), 1U) << "it stands 0.2 m from the border already";
  EXPECT_EQ(wider.violations[0].kind, DiscViolationKind::kRobotsTooNear);
  EXPECT_NEAR(wider.violations[0].needed_m, 0.6, 1e-9);
}

TEST(Courses, TheLeastClearanceIsThatOfTheWholeWay) {
  ObstacleRaster map = openMap();
  map.blocked[map.indexOf({100, 100})] = 1;  // 5 to 5.05 m
  const DiscCheck check = checkDiscs(map, {{0.3, 0.3}, 0.1}, {{{4, 4.6}, {6, 4.6}}, {{2, 2}}});
  EXPECT_TRUE(check.violations.empty());
  EXPECT_NEAR(check.least_clearance_m[0], 0.1, 1e-9);
  EXPECT_NEAR(check.least_clearance_m[1], 0.1 + DiscCheck::kFarM, 1e-9);
}

TEST(Courses, ListsWhatIsEmptyOrNowhere) {
  const ObstacleRaster map = openMap();
  const DiscCheck check =
      checkDiscs(map, {{0.3, 0.3, 0.3}, 0}, {{}, {{1, std::nan("")}}, {{-5, 2}}});
  ASSERT_EQ(check.violations.size(), 3U);
  EXPECT_EQ(check.violations[0].kind, DiscViolationKind::kEmptyCourse);
  EXPECT_EQ(check.violations[1].kind, DiscViolationKind::kNotFinite);
  EXPECT_EQ(check.violations[2].kind, DiscViolationKind::kNearBorder);
}

}  // namespace
}  // namespace split_mapf
