#pragma once

#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <split_mapf/CheckSolvable.h>
#include <split_mapf/ListSolvers.h>
#include <split_mapf/ValidatePlan.h>

#include "split_mapf/ros/goal_planner.h"
#include "split_mapf/ros/map_source.h"
#include "split_mapf/ros/options_loader.h"
#include "split_mapf/solver/registry.h"

namespace split_mapf {

/// The planner node's services: ~validate_plan, ~check_solvable and ~list_solvers.
class PlanServices {
 public:
  /// @pre all references outlive this object.
  PlanServices(ros::NodeHandle private_node, const SolverRegistry& solvers,
               const ServerOptions& options, const MapSource& maps,
               const GoalPlanner& goal_planner);

 private:
  bool validatePlan(ValidatePlan::Request& request, ValidatePlan::Response& response) const;
  bool checkSolvable(CheckSolvable::Request& request, CheckSolvable::Response& response) const;
  bool listSolvers(ListSolvers::Request& request, ListSolvers::Response& response) const;

  const SolverRegistry& solvers_;
  const ServerOptions& options_;
  const MapSource& maps_;
  const GoalPlanner& goal_planner_;
  ros::ServiceServer validate_;
  ros::ServiceServer check_;
  ros::ServiceServer list_;
};

}  // namespace split_mapf
