#include "ros/convert/robot_tasks.h"

#include <gtest/gtest.h>

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
  if (pose.header.frame_id != "shifted") throw TransformFailure("no such frame");
  geometry_msgs::Point point = pose.pose.position;
  point.x += 1;
  return point;
}

class PlaceRobots : public ::testing::Test {
 protected:
  PlacedRobots place(const std::vector<RobotTask>& tasks) const {
    return placeRobots(tasks, grid_, map_, transformShifted);
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

  const nav_msgs::OccupancyGrid map_ = mapFromAscii({"....", ".#?.", "...."});
  const PlanningGrid grid_ = makePlanningGrid(map_, {});
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
  for (const double w : {kNan, 0.5, 3.0, 1e-9}) {
    task.goal.pose.orientation.w = w;
    EXPECT_EQ(faultsOf({task}), Faults{"a:INVALID_POSE"}) << w;
  }
}

TEST_F(PlaceRobots, AnAllZeroQuaternionWasRefusedThoughItMeansNoHeading) {
  RobotTask task = taskBetween("a", poseAt(0.5, 0.5), poseAt(0.5, 2.5));
  task.start.pose.orientation = task.goal.pose.orientation = geometry_msgs::Quaternion();
  EXPECT_EQ(place({task}).goals.front(), (Cell{0, 0}));
}

TEST_F(PlaceRobots, AnUnknownCellWasCalledBlocked) {
  try {
    place({taskBetween("a", poseAt(2.5, 1.5), poseAt(1.5, 1.5))});
    FAIL() << "accepted";
  } catch (const GoalError& error) {
    ASSERT_EQ(error.faults().size(), 2U);
    const std::string& unknown = error.faults()[0].message;
    EXPECT_NE(unknown.find("(2,1), which is unknown"), std::string::npos) << unknown;
    EXPECT_NE(unknown.find("unknown_space 2"), std::string::npos) << unknown;
    const std::string& blocked = error.faults()[1].message;
    EXPECT_NE(blocked.find("(1,1), which is blocked (occupancy 100 %)"), std::string::npos)
        << blocked;
  }
}

TEST_F(PlaceRobots, AMegabyteAsIdOrFrameWasRepeatedInEveryFault) {
  const std::string huge(1000000, 'x');
  std::vector<RobotTask> tasks = {taskBetween(huge, poseAt(0.5, 0.5), poseAt(0.5, 2.5)),
                                  taskBetween(huge, poseAt(2.5, 0.5), poseAt(2.5, 2.5)),
                                  taskBetween("c", poseAt(3.5, 0.5), poseAt(3.5, 2.5))};
  tasks[2].start.header.frame_id = tasks[2].goal.header.frame_id = huge;
  try {
    place(tasks);
    FAIL() << "accepted";
  } catch (const GoalError& error) {
    EXPECT_LT(std::string(error.what()).size(), 400U);
    ASSERT_EQ(error.faults().size(), 4U);
    const std::vector<Outcome> codes = {Outcome::kInvalidOption, Outcome::kInvalidOption,
                                        Outcome::kInvalidPose, Outcome::kInvalidPose};
    for (std::size_t i = 0; i < 4; ++i) {
      const RobotFault& fault = error.faults()[i];
      EXPECT_EQ(fault.code, codeOf(codes[i]));
      EXPECT_LE(fault.robot_id.size(), 80U);
      EXPECT_LT(fault.message.size(), 400U);
      EXPECT_NE(fault.message.find("has 1000000 bytes; at most 256 are possible"),
                std::string::npos)
          << fault.message;
    }
    EXPECT_NE(error.faults()[1].message.find("robot 1 of the goal"), std::string::npos);
  }
  EXPECT_EQ(place({taskBetween(std::string(256, 'x'), poseAt(0.5, 0.5), poseAt(0.5, 2.5))})
                .ids.front()
                .size(),
            256U);
}

TEST_F(PlaceRobots, TwentyThousandFaultsBecomeAThousandAndTheirNumber) {
  std::vector<RobotTask> tasks;
  tasks.reserve(20000);
  for (int i = 0; i < 20000; ++i) {
    tasks.push_back(taskBetween(std::to_string(i), poseAt(1.5, 1.5), poseAt(-1, 0.5)));
  }
  try {
    place(tasks);
    FAIL() << "accepted";
  } catch (const GoalError& error) {
    ASSERT_EQ(error.faults().size(), 1000U);
    EXPECT_EQ(error.faults()[999].robot_id, "499");
    EXPECT_NE(std::string(error.what()).find("39999 more faults; the first 1000 are listed"),
              std::string::npos)
        << error.what();
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
