#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "split_mapf/core/plan_report.h"
#include "split_mapf/io/map_server.h"
#include "split_mapf/io/plan_json.h"
#include "split_mapf/io/pose_scenario.h"
#include "split_mapf/pipeline/disc_problem.h"
#include "tool/robot_options.h"

namespace split_mapf::tool {

/// Robots that have size, as files and options say it.
struct DiscFiles {
  OccupancyMap map;
  std::vector<PosedRobot> robots;
  DiscTask task;
};

/// Where a map lies.
MapFrame frameOf(const OccupancyMap& map);
/// What is asked of robots at these poses on a map. Radii that the scenario leaves open are the
/// option's.
DiscTask makeDiscTask(const OccupancyMap& map, const std::vector<PosedRobot>& robots,
                      const RobotOptions& options);
/// Reads map and scenario: of poses, or a MovingAI one, whose robots stand in the middle of their
/// cells. @throws InputError for a file at fault.
DiscFiles readDiscFiles(const std::string& map_file, const std::string& scenario_file,
                        std::optional<std::uint32_t> agents, const RobotOptions& options);

/// What the result file says of such robots; their poses where the report has a plan.
/// @throws as DiscProblem::coursesOf().
DiscResult discResultOf(const OccupancyMap& map, const std::vector<PosedRobot>& robots,
                        const DiscProblem& problem, double robot_speed_mps,
                        const PlanReport& report);

}  // namespace split_mapf::tool
