#include "split_mapf/ros/plan_services.h"

#include <exception>
#include <memory>

#include "split_mapf/ros/plan_check.h"

namespace split_mapf {

PlanServices::PlanServices(ros::NodeHandle private_node, const SolverRegistry& solvers,
                           const ServerOptions& options, const MapSource& maps)
    : solvers_(solvers), options_(options), maps_(maps) {
  const boost::function<bool(ValidatePlan::Request&, ValidatePlan::Response&)> validate =
      [this](ValidatePlan::Request& request, ValidatePlan::Response& response) {
        return validatePlan(request, response);
      };
  const boost::function<bool(ListSolvers::Request&, ListSolvers::Response&)> list =
      [this](ListSolvers::Request& request, ListSolvers::Response& response) {
        return listSolvers(request, response);
      };
  validate_ = private_node.advertiseService("validate_plan", validate);
  list_ = private_node.advertiseService("list_solvers", list);
}

bool PlanServices::validatePlan(ValidatePlan::Request& request,
                                ValidatePlan::Response& response) const {
  try {
    // The request outlives this call, so nothing is to be deleted.
    const std::shared_ptr<const nav_msgs::OccupancyGrid> sent(&request.map, [](const void*) {});
    const PlanningGrid grid = makePlanningGrid(*maps_.choose(sent), options_.goal.occupancy);
    response.violations = findViolations(request.plan, grid);
  } catch (const std::exception& error) {
    response.violations.emplace_back(error.what());
  }
  response.valid = response.violations.empty();
  return true;
}

bool PlanServices::listSolvers(ListSolvers::Request& /*request*/,
                               ListSolvers::Response& response) const {
  for (const std::string& name : solvers_.names()) {
    const SolverInfo& info = solvers_.info(name);
    std::string description = info.description;
    for (const OptionInfo& option : info.options) {
      description += "\n  " + option.name + "=" + option.default_value + "  " + option.description;
    }
    response.names.push_back(name);
    response.descriptions.push_back(description);
  }
  return true;
}

}  // namespace split_mapf
