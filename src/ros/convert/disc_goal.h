#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Path.h>
#include <split_mapf/MultiRobotPlan.h>
#include <split_mapf/RobotTask.h>
#include <visualization_msgs/MarkerArray.h>

#include "ros/convert/options_loader.h"
#include "ros/convert/pose_transformer.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/pipeline/disc_problem.h"
#include "split_mapf/ros/planning_grid.h"

namespace split_mapf {

/// Robots of a goal that have size, on a planning graph. Immutable.
struct DiscPlacement {
  DiscProblem problem;
  std::vector<geometry_msgs::Pose> starts;  ///< in the map's frame; an all-zero quaternion where
  std::vector<geometry_msgs::Pose> goals;   ///< the goal says no heading
};

/// The same with the robots' ids and the grid for the solvers.
struct PlacedDiscs {
  std::vector<std::string> ids;
  PlanningGrid grid;
};

/// Whether a goal needs a planning graph: a robot has size, or cells are not to be the map's.
bool asksForRoadmap(const GoalOptions& options, const std::vector<RobotTask>& tasks,
                    double resolution_m);

/// What a goal says of planning graphs, where none is made, is a mistake; what the server's
/// parameters say is for other goals. @throws OptionError naming the option.
void requireNoGraphOptions(const PlanOptions& asked);

/// Builds the planning graph of a goal's map and brings its robots onto it.
/// @param doing  is set to what a deadline would interrupt.
/// @throws GoalError: INVALID_MAP as makePlanningGrid(); or every robot at fault, in the goal's
/// order: OUTSIDE_MAP, BLOCKED_CELL (too near to an obstacle), UNPLACEABLE (discs overlap, more
/// robots than places), UNREACHABLE_GOAL (with the bottleneck of the widest way), and what
/// placeRobots() says of ids and poses. @throws OptionError as DiscProblem; Interrupted.
PlacedDiscs placeDiscs(const std::vector<RobotTask>& tasks, const nav_msgs::OccupancyGrid& map,
                       const GoalOptions& options, const PoseTransform& transform,
                       const Deadline& deadline, const char*& doing);

/// Fills in what a plan's message says of robots that have size. The discs are checked first.
/// @pre the message was made of `plan` on `grid`, which has discs. @throws as
/// DiscProblem::coursesOf().
void addDiscs(const PlanningGrid& grid, const Plan& plan, MultiRobotPlan& message,
              const Deadline& deadline);

/// Steps of the longest way by a plan, legs included.
std::uint32_t stepsOf(const DiscProblem& problem, const Plan& plan);

/// The planning graph for rviz: its edges, and its vertices as points.
visualization_msgs::MarkerArray roadmapMarkers(const PlanningGrid& grid, const ros::Time& stamp);

}  // namespace split_mapf
