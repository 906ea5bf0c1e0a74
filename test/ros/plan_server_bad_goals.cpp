// The planner node: goals that end without a plan, each with its outcome and the robots at fault.

#include <gtest/gtest.h>
#include <split_mapf/PlanOutcome.h>

#include <functional>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "ros/planner_node.h"

namespace split_mapf {
namespace {

using test::hardGoal;
using test::poseAt;
using test::runGoal;
using test::smallGoal;
using test::TrackedGoal;

/// A goal that ends without a plan, and how.
struct BadGoal {
  std::string name;
  std::int32_t outcome;
  std::function<void(PlanPathsGoal&)> spoil;
  std::vector<std::string> faulty;  ///< ids of the robots at fault, in order
  std::string expected_in_message;
};

std::ostream& operator<<(std::ostream& out, const BadGoal& bad) { return out << bad.name; }

class BadGoalTest : public test::PlannerNode, public ::testing::WithParamInterface<BadGoal> {};

TEST_P(BadGoalTest, EndsWithItsOutcomeAndTheNodeLivesOn) {
  PlanPathsGoal message = smallGoal();
  GetParam().spoil(message);
  TrackedGoal goal = runGoal(client_, message);
  const PlanPathsResult result = goal.result();
  EXPECT_EQ(result.outcome, GetParam().outcome) << result.message;
  EXPECT_EQ(goal.state(), "ABORTED");
  EXPECT_TRUE(result.plan.paths.empty());
  EXPECT_NE(result.message.find(GetParam().expected_in_message), std::string::npos)
      << result.message;
  std::vector<std::string> faulty;
  for (const RobotFault& fault : result.faults) {
    faulty.push_back(fault.robot_id);
    EXPECT_FALSE(fault.message.empty());
  }
  EXPECT_EQ(faulty, GetParam().faulty);
  if (!result.faults.empty()) {
    EXPECT_EQ(result.faults.front().code, result.outcome);
  }
  EXPECT_EQ(goal.timesDone(), 1);
  expectServing();
}

const std::vector<std::string> nobody;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Maps, BadGoalTest,
    ::testing::Values(BadGoal{"MisSized", PlanOutcome::INVALID_MAP,
                              [](auto& g) { g.map.data.pop_back(); }, nobody, "35 cells"},
                      BadGoal{"NoRows", PlanOutcome::INVALID_MAP,
                              [](auto& g) { g.map.info.height = 0; }, nobody, "6x0"},
                      BadGoal{"FrameOfAMegabyte", PlanOutcome::INVALID_MAP,
                              [](auto& g) { g.map.header.frame_id.assign(1000000, 'x'); }, nobody,
                              "has 1000000 bytes; at most 256 are possible"},
                      BadGoal{"FarOrigin", PlanOutcome::INVALID_MAP,
                              [](auto& g) { g.map.info.origin.position.x = 1e300; }, nobody,
                              "1e+300"},
                      BadGoal{"Resolution", PlanOutcome::INVALID_MAP,
                              [](auto& g) { g.map.info.resolution = -0.1F; }, nobody, "resolution"},
                      BadGoal{"NoFreeCell",
                              PlanOutcome::BLOCKED_CELL,
                              [](auto& g) { std::fill(g.map.data.begin(), g.map.data.end(), 100); },
                              {"left", "left", "right", "right"},
                              "'left'"}),
    [](const auto& info) { return info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Options, BadGoalTest,
    ::testing::Values(
        BadGoal{"Solver", PlanOutcome::UNKNOWN_SOLVER, [](auto& g) { g.options.solver = "oracle"; },
                nobody, "oracle"},
        BadGoal{"SolverOption", PlanOutcome::INVALID_OPTION,
                [](auto& g) {
                  g.options.solver = "ecbs";
                  g.options.solver_options = {"colour=red"};
                },
                nobody, "colour"},
        BadGoal{"OptionOfNoSolver", PlanOutcome::INVALID_OPTION,
                [](auto& g) { g.options.solver_options = {"order=random"}; }, nobody, "auto"},
        BadGoal{"SplitText", PlanOutcome::INVALID_SPLIT, [](auto& g) { g.options.split = "8q"; },
                nobody, "8q"},
        BadGoal{"SplitRatios", PlanOutcome::INVALID_SPLIT,
                [](auto& g) { g.options.split = "t(0.5,0.6)"; }, nobody, "t(0.5,0.6)"},
        BadGoal{"SplitOption", PlanOutcome::INVALID_OPTION,
                [](auto& g) { g.options.split = "2t", g.options.split_options = {"colour=red"}; },
                nobody, "colour"},
        BadGoal{"Objective", PlanOutcome::INVALID_OPTION,
                [](auto& g) { g.options.objective = "joy"; }, nobody, "joy"},
        BadGoal{"Suboptimality", PlanOutcome::INVALID_OPTION,
                [](auto& g) { g.options.suboptimality = 0.5; }, nobody, "0.5"},
        BadGoal{"TimeLimit", PlanOutcome::INVALID_OPTION,
                [](auto& g) { g.options.time_limit = kNan; }, nobody, "time_limit"},
        BadGoal{"RobotRadius", PlanOutcome::INVALID_OPTION,
                [](auto& g) { g.options.robot_radius = 30; }, nobody, "nowhere on the map"},
        BadGoal{"CellSize", PlanOutcome::INVALID_OPTION,
                [](auto& g) { g.options.robot_radius = 0.4, g.options.cell_size = 1; }, nobody,
                "at least 2 m is needed"},
        BadGoal{"SnapDistance", PlanOutcome::INVALID_OPTION,
                [](auto& g) { g.options.robot_radius = 0.3, g.options.snap_distance = 100; },
                nobody, "ten cell sizes"},
        BadGoal{"UnknownSpace", PlanOutcome::INVALID_OPTION,
                [](auto& g) { g.options.unknown_space = 9; }, nobody, "unknown_space 9"},
        BadGoal{"Threshold", PlanOutcome::INVALID_OPTION,
                [](auto& g) { g.options.occupied_threshold = 120; }, nobody, "120"},
        BadGoal{"AMillionSolverOptions", PlanOutcome::INVALID_OPTION,
                [](auto& g) {
                  g.options.solver = "ecbs";
                  g.options.solver_options.assign(1000000, "a=b");
                },
                nobody, "there are 1000000"},
        BadGoal{"SolverOfAMegabyte", PlanOutcome::UNKNOWN_SOLVER,
                [](auto& g) { g.options.solver.assign(1000000, 'x'); }, nobody,
                "xxx...' is unknown"},
        BadGoal{"SplitOfAMegabyte", PlanOutcome::INVALID_SPLIT,
                [](auto& g) { g.options.split.assign(1000000, '4'); }, nobody, "1000000 bytes"},
        BadGoal{"ObjectiveOfAMegabyte", PlanOutcome::INVALID_OPTION,
                [](auto& g) { g.options.objective.assign(1000000, 'x'); }, nobody, "xxx..."},
        BadGoal{"HugeSuboptimality", PlanOutcome::INVALID_OPTION,
                [](auto& g) { g.options.suboptimality = 1e300; }, nobody, "1e+300"},
        BadGoal{"HugeTimeLimit", PlanOutcome::INVALID_OPTION,
                [](auto& g) { g.options.time_limit = 1e300; }, nobody, "time_limit 1e+300"},
        BadGoal{"HugeThreads", PlanOutcome::INVALID_OPTION,
                [](auto& g) { g.options.threads = 4000000000U; }, nobody, "threads 4000000000"},
        BadGoal{"StepDurationBeyondRosTime", PlanOutcome::INVALID_OPTION,
                [](auto& g) { g.options.fill_poses = true, g.options.step_duration = 1e9; }, nobody,
                "step_duration 1e+09"},
        BadGoal{"StepDuration", PlanOutcome::INVALID_OPTION,
                [](auto& g) { g.options.step_duration = 0.1, g.options.robot_speed = 1; }, nobody,
                "too short"}),
    [](const auto& info) { return info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Robots, BadGoalTest,
    ::testing::Values(
        BadGoal{"None", PlanOutcome::NO_ROBOTS, [](auto& g) { g.robots.clear(); }, nobody,
                "no robots"},
        BadGoal{"SameId",
                PlanOutcome::DUPLICATE_ROBOT_ID,
                [](auto& g) { g.robots[1].robot_id = "left"; },
                {"left", "left"},
                "'left'"},
        BadGoal{"IdOfAnIndex",
                PlanOutcome::DUPLICATE_ROBOT_ID,
                [](auto& g) { g.robots[0].robot_id = "", g.robots[1].robot_id = "0"; },
                {"0", "0"},
                "'0'"},
        BadGoal{"Outside",
                PlanOutcome::OUTSIDE_MAP,
                [](auto& g) { g.robots[1].goal = poseAt(6.5, 0.5); },
                {"right"},
                "'right'"},
        BadGoal{"Blocked",
                PlanOutcome::BLOCKED_CELL,
                [](auto& g) { g.map.data[12] = 100; },
                {"left"},
                "(0,2)"},
        BadGoal{"Unknown",
                PlanOutcome::BLOCKED_CELL,
                [](auto& g) { g.map.data[12] = -1; },
                {"left"},
                "(0,2)"},
        BadGoal{"SameStart",
                PlanOutcome::DUPLICATE_START,
                [](auto& g) { g.robots[1].start = g.robots[0].start; },
                {"left", "right"},
                "start"},
        BadGoal{"SameGoal",
                PlanOutcome::DUPLICATE_GOAL,
                [](auto& g) { g.robots[1].goal = g.robots[0].goal; },
                {"left", "right"},
                "goal"},
        BadGoal{"OneCell",
                PlanOutcome::UNPLACEABLE,
                [](auto& g) { g.robots[1].start = poseAt(0.9, 2.1); },
                {"left", "right"},
                "planning cell (0,2)"},
        BadGoal{"CutOff",
                PlanOutcome::UNREACHABLE_GOAL,
                [](auto& g) {
                  for (int row = 0; row < 6; ++row) g.map.data[row * 6U + 3] = 100;
                },
                {"left", "right"},
                "no free way"},
        BadGoal{"NanPose",
                PlanOutcome::INVALID_POSE,
                [](auto& g) { g.robots[0].start.pose.position.x = kNan; },
                {"left"},
                "finite"},
        BadGoal{"NoQuaternion",
                PlanOutcome::INVALID_POSE,
                [](auto& g) { g.robots[1].goal.pose.orientation.w = 0.5; },
                {"right"},
                "quaternion"},
        BadGoal{"NoFrame",
                PlanOutcome::TRANSFORM_FAILED,
                [](auto& g) { g.robots[1].start.header.frame_id = "moon"; },
                {"right"},
                "'moon'"},
        BadGoal{"IdOfAMegabyte",
                PlanOutcome::INVALID_OPTION,
                [](auto& g) { g.robots[1].robot_id.assign(1000000, 'x'); },
                {std::string(77, 'x') + "..."},
                "its robot_id has 1000000 bytes; at most 256 are possible"},
        BadGoal{"PoseFrameOfAMegabyte",
                PlanOutcome::INVALID_POSE,
                [](auto& g) { g.robots[1].goal.header.frame_id.assign(1000000, 'x'); },
                {"right"},
                "its goal has a frame_id that has 1000000 bytes"},
        BadGoal{"FrameOfTwoSlashes",
                PlanOutcome::TRANSFORM_FAILED,
                [](auto& g) { g.robots[1].start.header.frame_id = "//moon"; },
                {"right"},
                "slash"},
        BadGoal{"NobodyPublishesTheFrame",
                PlanOutcome::TRANSFORM_FAILED,
                [](auto& g) { g.robots[1].start.header.frame_id = "moon"; },
                {"right"},
                "nobody publishes frame 'moon', waited up to 1 s (tf2 says: "},
        BadGoal{"UnknownCell",
                PlanOutcome::BLOCKED_CELL,
                [](auto& g) { g.map.data[12] = -1; },
                {"left"},
                "(0,2), which is unknown; a free cell is needed, or the option "
                "unknown_space 2"},
        BadGoal{"Several",
                PlanOutcome::OUTSIDE_MAP,
                [](auto& g) {
                  g.robots[0].start = poseAt(-1, 0);
                  g.robots[1].goal = poseAt(kNan, 0);
                },
                {"left", "right"},
                "1 more"}),
    [](const auto& info) { return info.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Searches, BadGoalTest,
    ::testing::Values(BadGoal{"Timeout", PlanOutcome::TIMEOUT,
                              [](auto& g) { g = hardGoal(), g.options.time_limit = 0.5; }, nobody,
                              "time"},
                      BadGoal{"NoTime", PlanOutcome::TIMEOUT,
                              [](auto& g) { g.options.time_limit = -1; }, nobody, "time"}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace split_mapf
