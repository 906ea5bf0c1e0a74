#pragma once

#include <cstdint>
#include <memory>

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/spinner.h>
#include <split_mapf/CheckSolvable.h>
#include <split_mapf/ListSolvers.h>
#include <split_mapf/ValidatePlan.h>

#include "ros/convert/map_source.h"
#include "ros/convert/options_loader.h"
#include "ros/server/goal_planner.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/solver/registry.h"

namespace split_mapf {

/// The planner node's services: ~validate_plan, ~check_solvable and ~list_solvers. The first two
/// may take long: they have a queue and threads of their own, so that however many callers there
/// are, goals and cancels are heard, and no more of them run at once than there are threads. Each
/// takes the time limit of its options, or the server's, at most, counted from when its turn comes.
class PlanServices {
 public:
  /// @param threads  that serve the callers, at least 1. @pre all references outlive this object.
  PlanServices(ros::NodeHandle private_node, const SolverRegistry& solvers, const MapSource& maps,
               const GoalPlanner& goal_planner, std::uint32_t threads);
  /// Calls shutdown().
  ~PlanServices();
  PlanServices(const PlanServices&) = delete;
  PlanServices& operator=(const PlanServices&) = delete;

  /// Serves nobody any more; who is being served is told so. Within 200 ms.
  void shutdown();

 private:
  bool validatePlan(ValidatePlan::Request& request, ValidatePlan::Response& response) const;
  bool checkSolvable(CheckSolvable::Request& request, CheckSolvable::Response& response) const;
  bool listSolvers(ListSolvers::Request& request, ListSolvers::Response& response) const;

  const SolverRegistry& solvers_;
  const MapSource& maps_;
  const GoalPlanner& goal_planner_;
  const std::shared_ptr<StopFlag> stop_ = std::make_shared<StopFlag>();
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_;
  ros::ServiceServer validate_;
  ros::ServiceServer check_;
  ros::ServiceServer list_;
};

}  // namespace split_mapf
