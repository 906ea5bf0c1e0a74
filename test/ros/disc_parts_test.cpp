// Parts of an execution of robots that have size, without a master.
#include "ros/fleet/disc_parts.h"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ros/convert/disc_goal.h"
#include "ros/goal_messages.h"
#include "solver/available/available_solvers.h"
#include "split_mapf/pipeline/planner.h"
#include "split_mapf/ros/plan_messages.h"

namespace split_mapf {
namespace {

using test::poseAt;
using test::taskBetween;

/// A robot of 0.3 m crosses a room of 6 m x 4 m; others stand on vertices.
struct Room {
  Room() : map(test::mapFromAscii(std::vector<std::string>(80, std::string(120, '.')))) {
    map.info.resolution = 0.05F;
    options.roadmap.robot_radius_m = 0.3;
    const std::vector<RobotTask> tasks = {taskBetween("a", poseAt(0.5, 0.5), poseAt(5.4, 0.55))};
    const char* doing = "";
    const PlacedDiscs discs = placeDiscs(tasks, map, options, {}, Deadline(), doing);
    Executor executor(1);
    const PlanReport report = Planner(availableSolvers(), executor)
                                  .plan(discs.grid.discs->problem.instance(), {}, Deadline(60));
    EXPECT_TRUE(report.plan) << report.message;
    plan = toMessage(report, discs.ids, discs.grid, 1, ros::Time(100), {});
    parts = std::make_shared<const DiscParts>(plan, map, options);
  }

  JoiningDisc joining(const std::string& id, PlanePoint place) const {
    JoiningDisc robot;
    robot.id = id;
    robot.goal = parts->vertexFor(place).value_or(kNoVertex);
    robot.place = place;
    EXPECT_NE(robot.goal, kNoVertex);
    return robot;
  }

  nav_msgs::OccupancyGrid map;
  GoalOptions options;
  MultiRobotPlan plan;
  std::shared_ptr<const DiscParts> parts;
};

TEST(DiscParts, ARobotThatJoinedTwiceGotTheLegOfAnotherAfterARestart) {
  const Room room;
  const JoiningDisc at_first = room.joining("d", {1.02, 3.03});
  const JoiningDisc other = room.joining("e", {3.01, 3.02});
  const JoiningDisc again = room.joining("d", {4.73, 3.04});
  const std::vector<std::string> ids = {"a", "d", "e"};
  const auto last = [&](const DiscParts& parts) { return parts.part(2, ids, {}); };
  const FleetPart live = last(*room.parts->with(at_first)->with(other)->with(again));
  // A restart knows who joined last, in that order.
  const FleetPart after = last(*room.parts->with(other)->with(again));
  EXPECT_EQ(live.ids, after.ids);
  ASSERT_EQ(live.ids.size(), ids.size());
  for (Vertex v = 0; v < 2 * ids.size(); ++v) {
    EXPECT_EQ(live.moves->place(v).x, after.moves->place(v).x) << v;
    EXPECT_EQ(live.moves->place(v).y, after.moves->place(v).y) << v;
  }
}

TEST(DiscParts, ARobotOfThePlanThatComesAgainKeepsItsNumber) {
  const Room room;
  const JoiningDisc other = room.joining("e", {3.01, 3.02});
  const JoiningDisc again = room.joining("a", {4.73, 3.04});
  const FleetPart last = room.parts->with(other)->with(again)->part(2, {"e", "a"}, {});
  EXPECT_EQ(last.ids, (std::vector<std::string>{"a", "e"}));
  EXPECT_NEAR(last.moves->place(last.plan.paths[0].back()).x, again.place.x, 1e-9);
}

TEST(DiscParts, ARobotThatLeftDroveOntoTheGraphPastOneThatJoined) {
  const Room room;
  // On the raster, whose rows begin at the top.
  const PlanePoint start{0.5, 3.5};
  EXPECT_EQ(room.parts->whoComesNear(start, {"a"}), "a");
  EXPECT_EQ(room.parts->whoComesNear(start, {}), std::nullopt);
}

}  // namespace
}  // namespace split_mapf
