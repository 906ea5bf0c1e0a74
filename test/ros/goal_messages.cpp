#include "ros/goal_messages.h"

#include <stdexcept>

#include "split_mapf/generate/generator.h"

namespace split_mapf::test {
namespace {

std::int8_t occupancyOf(char letter) {
  switch (letter) {
    case '.':
      return 0;
    case '#':
      return 100;
    case '?':
      return -1;
    default:
      throw std::invalid_argument(std::string("no cell is drawn as ") + letter);
  }
}

}  // namespace

nav_msgs::OccupancyGrid mapFromAscii(const std::vector<std::string>& rows) {
  nav_msgs::OccupancyGrid map;
  map.header.frame_id = "map";
  map.info.resolution = 1;
  map.info.width = static_cast<std::uint32_t>(rows.front().size());
  map.info.height = static_cast<std::uint32_t>(rows.size());
  map.info.origin.orientation.w = 1;
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    for (const char letter : *row) map.data.push_back(occupancyOf(letter));
  }
  return map;
}

geometry_msgs::PoseStamped poseAt(double x, double y) {
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = "map";
  pose.pose.position.x = x;
  pose.pose.position.y = y;
  pose.pose.orientation.w = 1;
  return pose;
}

RobotTask taskBetween(const std::string& id, const geometry_msgs::PoseStamped& start,
                      const geometry_msgs::PoseStamped& goal) {
  RobotTask task;
  task.robot_id = id;
  task.start = start;
  task.goal = goal;
  return task;
}

PlanPathsGoal smallGoal() {
  PlanPathsGoal goal;
  goal.map = mapFromAscii(std::vector<std::string>(6, "......"));
  goal.robots.push_back(taskBetween("left", poseAt(0.5, 2.5), poseAt(5.5, 2.5)));
  goal.robots.push_back(taskBetween("right", poseAt(5.5, 3.5), poseAt(0.5, 3.5)));
  return goal;
}

PlanPathsGoal hardGoal() {
  GeneratorOptions options;
  options.width = 24;
  options.height = 24;
  options.density = 0.2;
  options.robots = 110;
  options.seed = 4;
  const GeneratedProblem problem = generateProblem(options);
  PlanPathsGoal goal;
  std::vector<std::string> rows(options.height, std::string(options.width, '#'));
  for (Vertex v = 0; v < problem.grid->size(); ++v) {
    const Cell cell = problem.grid->cellOf(v);
    rows[static_cast<std::size_t>(cell.y)][static_cast<std::size_t>(cell.x)] = '.';
  }
  goal.map = mapFromAscii(rows);
  const auto centre_of = [&](Cell cell) {
    return poseAt(cell.x + 0.5, options.height - cell.y - 0.5);
  };
  for (std::size_t i = 0; i < problem.starts.size(); ++i) {
    goal.robots.push_back(
        taskBetween("", centre_of(problem.starts[i]), centre_of(problem.goals[i])));
  }
  goal.options.solver = "ecbs";
  goal.options.split = "none";
  goal.options.suboptimality = 1;
  goal.options.objective = "sum_of_costs";
  return goal;
}

MultiRobotPlan smallPlan() {
  MultiRobotPlan plan;
  plan.header.frame_id = "map";
  plan.grid = mapFromAscii({"....", "...."}).info;
  plan.step_duration = 1;
  plan.paths.resize(2);
  plan.paths[0].robot_id = "a";
  plan.paths[0].cells = {0, 1, 2, 6};
  plan.paths[1].robot_id = "b";
  plan.paths[1].cells = {7};
  return plan;
}

}  // namespace split_mapf::test
