#include "split_mapf/ros/robot_tasks.h"

#include <gtest/gtest.h>
#include <tf2/exceptions.h>

#include <limits>

#include "ros/goal_messages.h"
#include "split_mapf/ros/outcome.h"

namespace split_mapf {
namespace {

using test::mapFromAscii;
using test::poseAt;
using test::taskBetween;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Knows the frame `shifted`, whose origin lies at (1, 0) of the map.
geometry_msgs::Point transformShifted(const geometry_msgs::PoseStamped& pose,
                                      const std::string& /*frame*/) {
  if (pose.header.frame_id != "shifted") throw tf2::LookupException("no such frame");
  geometry_msgs::Point point = pose.pose.position;
  point.x += 1;
  return point;
}

class PlaceRobots : public ::testing::Test {
 protected:
  PlacedRobots place(const std::vector<RobotTask>& tasks) const {
    return placeRobots(tasks, grid_, transformShifted);
  }
  /// "id:CODE" of every fault, in order.
  std::vector<std::string> faultsOf(const std::vector<RobotTask>& tasks) const {
    std::vector<std::string> faults;
    try {
      place(tasks);
    } catch (const GoalError& error) {
      EXPECT_EQ(codeOf(error.outcome()), error.faults().front().code);
      for (const RobotFault& fault : error.faults()) {
        faults.push_back(fault.robot_id + ":" + toString(static_cast<Outcome>(fault.code)));
        EXPECT_NE(fault.message.find("'" + fault.robot_id + "'"), std::string::npos)
            << fault.message;
      }
    }
    return faults;
  }
  using Faults = std::vector<std::string>;

  const PlanningGrid grid_ = makePlanningGrid(mapFromAscii({"....", ".#..", "...."}), {});
};

TEST_F(PlaceRobots, FindsTheCellsOfPoses) {
  const PlacedRobots placed = place({taskBetween("", poseAt(0.1, 0.1), poseAt(3.9, 2.9)),
                                     taskBetween("b", poseAt(1, 0), poseAt(0, 2))});
  EXPECT_EQ(placed.ids, (std::vector<std::string>{"0", "b"}));
  EXPECT_EQ(placed.starts, (std::vector<Cell>{{0, 2}, {1, 2}}));
  EXPECT_EQ(placed.goals, (std::vector<Cell>{{3, 0}, {0, 0}}));
}

TEST_F(PlaceRobots, TransformsPosesOfOtherFrames) {
  RobotTask task = taskBetween("a", poseAt(0.5, 0.5), poseAt(0.5, 2.5));
  task.start.header.frame_id = "shifted";
  task.goal.header.frame_id = "";
  EXPECT_EQ(place({task}).starts.front(), (Cell{1, 2}));
  EXPECT_EQ(place({task}).goals.front(), (Cell{0, 0}));
  task.goal.header.frame_id = "/map";
  EXPECT_EQ(place({task}).goals.front(), (Cell{0, 0}));
}

TEST_F(PlaceRobots, NamesRobotAndFramesWhenATransformFails) {
  RobotTask task = taskBetween("a", poseAt(0.5, 0.5), poseAt(0.5, 2.5));
  task.goal.header.frame_id = "nowhere";
  try {
    place({task});
    FAIL() << "accepted";
  } catch (const GoalError& error) {
    EXPECT_EQ(error.outcome(), Outcome::kTransformFailed);
    for (const char* part : {"'a'", "goal", "'nowhere'", "'map'", "no such frame"}) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part;
    }
  }
}

TEST_F(PlaceRobots, NeedsRobots) {
  try {
    place({});
    FAIL() << "accepted";
  } catch (const GoalError& error) {
    EXPECT_EQ(error.outcome(), Outcome::kNoRobots);
  }
}

TEST_F(PlaceRobots, RefusesPosesThatAreNone) {
  for (const double bad : {kNan, std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(faultsOf({taskBetween("a", poseAt(bad, 1), poseAt(0.5, 0.5))}),
              Faults{"a:INVALID_POSE"});
    EXPECT_EQ(faultsOf({taskBetween("a", poseAt(0.5, 0.5), poseAt(1, bad))}),
              Faults{"a:INVALID_POSE"});
  }
  RobotTask task = taskBetween("a", poseAt(0.5, 0.5), poseAt(0.5, 2.5));
  for (const double w : {0.0, kNan, 0.5, 3.0}) {
    task.goal.pose.orientation.w = w;
    EXPECT_EQ(faultsOf({task}), Faults{"a:INVALID_POSE"}) << w;
  }
}

TEST_F(PlaceRobots, RefusesCellsThatAreNotFree) {
  EXPECT_EQ(faultsOf({taskBetween("a", poseAt(-1, 0.5), poseAt(0.5, 0.5))}),
            Faults{"a:OUTSIDE_MAP"});
  EXPECT_EQ(faultsOf({taskBetween("a", poseAt(0.5, 0.5), poseAt(1.5, 1.5))}),
            Faults{"a:BLOCKED_CELL"});
}

TEST_F(PlaceRobots, TellsEqualPositionsFromCrowdedCells) {
  const auto goal = [](int i) { return poseAt(i + 0.5, 2.5); };
  EXPECT_EQ(faultsOf({taskBetween("a", poseAt(0.5, 0.5), goal(0)),
                      taskBetween("b", poseAt(0.5, 0.5), goal(1))}),
            (Faults{"a:DUPLICATE_START", "b:DUPLICATE_START"}));
  EXPECT_EQ(faultsOf({taskBetween("a", poseAt(0.5, 0.5), goal(0)),
                      taskBetween("b", poseAt(1.5, 0.5), goal(0))}),
            (Faults{"a:DUPLICATE_GOAL", "b:DUPLICATE_GOAL"}));
  EXPECT_EQ(faultsOf({taskBetween("a", poseAt(0.2, 0.5), goal(0)),
                      taskBetween("b", poseAt(0.7, 0.5), goal(1))}),
            (Faults{"a:UNPLACEABLE", "b:UNPLACEABLE"}));
}

TEST_F(PlaceRobots, RefusesOneIdForTwo) {
  EXPECT_EQ(faultsOf({taskBetween("1", poseAt(0.5, 0.5), poseAt(0.5, 0.5)),
                      taskBetween("", poseAt(1.5, 0.5), poseAt(1.5, 0.5)),
                      taskBetween("c", poseAt(2.5, 0.5), poseAt(2.5, 0.5))}),
            (Faults{"1:DUPLICATE_ROBOT_ID", "1:DUPLICATE_ROBOT_ID"}));
}

TEST_F(PlaceRobots, ListsEveryFaultInTheGoalsOrder) {
  EXPECT_EQ(
      faultsOf({taskBetween("a", poseAt(0.5, 0.5), poseAt(9, 0.5)),
                taskBetween("b", poseAt(1.5, 1.5), poseAt(-3, 0.5)),
                taskBetween("c", poseAt(2.5, 0.5), poseAt(0.5, 2.5)),
                taskBetween("d", poseAt(kNan, 0.5), poseAt(0.5, 2.5)),
                taskBetween("e", poseAt(0.5, 0.5), poseAt(3.5, 0.5))}),
      (Faults{"a:DUPLICATE_START", "a:OUTSIDE_MAP", "b:BLOCKED_CELL", "b:OUTSIDE_MAP",
              "c:DUPLICATE_GOAL", "d:INVALID_POSE", "d:DUPLICATE_GOAL", "e:DUPLICATE_START"}));
}

TEST(RequireReachableGoals, ListsEveryRobotThatIsCutOff) {
  const PlanningGrid grid = makePlanningGrid(mapFromAscii({"..#..", "..#..", "..#.."}), {});
  const Instance instance(grid.grid, {{0, 0}, {0, 1}, {3, 0}}, {{4, 0}, {1, 1}, {0, 2}});
  try {
    requireReachableGoals(instance, {"a", "b", "c"}, grid.geometry);
    FAIL() << "accepted";
  } catch (const GoalError& error) {
    EXPECT_EQ(error.outcome(), Outcome::kUnreachableGoal);
    ASSERT_EQ(error.faults().size(), 2U);
    EXPECT_EQ(error.faults()[0].robot_id, "a");
    EXPECT_EQ(error.faults()[1].robot_id, "c");
    EXPECT_NE(std::string(error.what()).find("(4,2)"), std::string::npos) << error.what();
  }
  const Instance fine(grid.grid, {{0, 0}}, {{1, 2}});
  EXPECT_NO_THROW(requireReachableGoals(fine, {"a"}, grid.geometry));
}

}  // namespace
}  // namespace split_mapf
