#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nav_msgs/OccupancyGrid.h>
#include <split_mapf/MultiRobotPlan.h>
#include <split_mapf/PlanPathsGoal.h>
#include <split_mapf/RobotTask.h>

namespace split_mapf::test {

/// A map in frame `map` with cells of 1 m, one string a row from the top: '.' is free, '#' is
/// blocked, '?' is unknown. Its lower left corner is the origin.
nav_msgs::OccupancyGrid mapFromAscii(const std::vector<std::string>& rows);

/// A pose in frame `map` that heads along x.
geometry_msgs::PoseStamped poseAt(double x, double y);
RobotTask taskBetween(const std::string& id, const geometry_msgs::PoseStamped& start,
                      const geometry_msgs::PoseStamped& goal);

/// Two robots that pass each other in an open square of 6 by 6 cells; optimal makespan 5.
PlanPathsGoal smallGoal();
/// A dense grid that ECBS at suboptimality 1 does not solve within minutes.
PlanPathsGoal hardGoal();
/// Robots a, which moves for three steps, and b, which stands, on 4 by 2 cells.
MultiRobotPlan smallPlan();

}  // namespace split_mapf::test
