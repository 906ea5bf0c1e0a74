#include "tool/disc_task.h"

#include <memory>
#include <utility>

#include "split_mapf/core/wording.h"
#include "split_mapf/io/movingai.h"

namespace split_mapf::tool {
namespace {

MapPoint pointOf(const MapPose& pose) { return {pose.x_m, pose.y_m}; }

/// A scenario of cells as one of poses.
std::vector<PosedRobot> posesOf(const Scenario& scenario, const OccupancyMap& map) {
  const MapFrame frame = frameOf(map);
  const auto centre_of = [&](Cell cell) {
    const MapPoint p =
        toFrame(frame, {(cell.x + 0.5) * map.resolution_m, (cell.y + 0.5) * map.resolution_m});
    return MapPose{p.x, p.y, 0};
  };
  std::vector<PosedRobot> robots;
  for (std::size_t i = 0; i < scenario.starts.size(); ++i) {
    robots.push_back({std::to_string(i), centre_of(scenario.starts[i]),
                      centre_of(scenario.goals[i]), std::nullopt});
  }
  return robots;
}

}  // namespace

MapFrame frameOf(const OccupancyMap& map) {
  return {map.origin.x_m, map.origin.y_m, map.origin.yaw_rad,
          map.grid->height() * map.resolution_m};
}

DiscTask makeDiscTask(const OccupancyMap& map, const std::vector<PosedRobot>& robots,
                      const RobotOptions& options) {
  DiscTask task;
  task.raster = std::make_shared<const ObstacleRaster>(obstaclesOf(map, options));
  task.frame = frameOf(map);
  task.roadmap = options.roadmap;
  task.snap_distance_m = options.snap_distance_m;
  for (const PosedRobot& robot : robots) {
    task.names.push_back("robot " + quote(robot.id));
    task.robots.push_back({toRaster(task.frame, pointOf(robot.start)),
                           toRaster(task.frame, pointOf(robot.goal)),
                           robot.radius_m.value_or(options.roadmap.robot_radius_m)});
  }
  return task;
}

DiscFiles readDiscFiles(const std::string& map_file, const std::string& scenario_file,
                        std::optional<std::uint32_t> agents, const RobotOptions& options) {
  DiscFiles files;
  files.map = readMapInMetres(map_file, options);
  if (isPoseScenario(scenario_file)) {
    files.robots = readPoseScenario(scenario_file, agents);
  } else {
    const MapSize size{files.map.grid->width(), files.map.grid->height()};
    files.robots = posesOf(readMovingAiScenario(scenario_file, size, agents), files.map);
  }
  files.task = makeDiscTask(files.map, files.robots, options);
  return files;
}

DiscResult discResultOf(const OccupancyMap& map, const std::vector<PosedRobot>& robots,
                        const DiscProblem& problem, double robot_speed_mps,
                        const PlanReport& report) {
  DiscResult result;
  result.resolution_m = map.resolution_m;
  result.origin = map.origin;
  result.robot_radius_m = problem.roadmap().robot_radius_m;
  result.clearance_m = problem.roadmap().clearance_m;
  result.longest_step_m = problem.longestStep();
  if (robot_speed_mps > 0) result.step_duration_sec = problem.longestStep() / robot_speed_mps;
  result.departure_steps = problem.attachment().departure.steps;
  result.arrival_steps = problem.attachment().arrival.steps;
  result.radius_m = problem.discs().radius_m;
  for (const PosedRobot& robot : robots) result.ids.push_back(robot.id);
  if (!report.plan) return result;
  DiscCourses ways = problem.coursesOf(*report.plan);
  result.least_clearance_m = std::move(ways.least_clearance_m);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    std::vector<MapPoint>& poses = result.poses.emplace_back();
    for (const MapPoint& p : ways.courses[i]) poses.push_back(toFrame(problem.task().frame, p));
    // Exactly as they were given, not as turned to and fro.
    poses.front() = pointOf(robots[i].start);
    poses.back() = pointOf(robots[i].goal);
  }
  return result;
}

}  // namespace split_mapf::tool
