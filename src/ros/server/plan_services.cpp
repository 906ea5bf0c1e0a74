#include "ros/server/plan_services.h"

#include <exception>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include <boost/make_shared.hpp>

#include "ros/convert/plan_check.h"
#include "ros/convert/unsolvable_text.h"
#include "split_mapf/ros/plan_messages.h"
#include "split_mapf/solvability/solvability.h"

namespace split_mapf {
namespace {

Outcome outcomeOf(Solvability answer) {
  if (answer == Solvability::kSolvable) return Outcome::kSucceeded;
  return answer == Solvability::kUnsolvable ? Outcome::kUnsolvable : Outcome::kTimeout;
}

}  // namespace

PlanServices::PlanServices(ros::NodeHandle private_node, const SolverRegistry& solvers,
                           const MapSource& maps, const GoalPlanner& goal_planner,
                           std::uint32_t threads)
    : solvers_(solvers), maps_(maps), goal_planner_(goal_planner), spinner_(threads, &queue_) {
  const boost::function<bool(ValidatePlan::Request&, ValidatePlan::Response&)> validate =
      [this](ValidatePlan::Request& request, ValidatePlan::Response& response) {
        return validatePlan(request, response);
      };
  const boost::function<bool(CheckSolvable::Request&, CheckSolvable::Response&)> check =
      [this](CheckSolvable::Request& request, CheckSolvable::Response& response) {
        return checkSolvable(request, response);
      };
  const boost::function<bool(ListSolvers::Request&, ListSolvers::Response&)> list =
      [this](ListSolvers::Request& request, ListSolvers::Response& response) {
        return listSolvers(request, response);
      };
  list_ = private_node.advertiseService("list_solvers", list);
  ros::NodeHandle slow_node(private_node);
  slow_node.setCallbackQueue(&queue_);
  validate_ = slow_node.advertiseService("validate_plan", validate);
  check_ = slow_node.advertiseService("check_solvable", check);
  spinner_.start();
}

PlanServices::~PlanServices() { shutdown(); }

void PlanServices::shutdown() {
  stop_->request();
  validate_.shutdown();
  check_.shutdown();
  queue_.disable();
  spinner_.stop();
}

bool PlanServices::validatePlan(ValidatePlan::Request& request,
                                ValidatePlan::Response& response) const {
  try {
    // The request outlives this call, so nothing is to be deleted.
    const std::shared_ptr<const nav_msgs::OccupancyGrid> sent(&request.map, [](const void*) {});
    const GoalOptions asked = goal_planner_.defaults();
    const Deadline deadline(asked.plan.time_limit_sec, stop_);
    const std::shared_ptr<const nav_msgs::OccupancyGrid> map = maps_.choose(sent);
    if (isOnRoadmap(request.plan)) {
      const MapGeometry geometry(map->info, map->header.frame_id);
      const ObstacleRaster raster =
          makeRaster(*map, asked.occupancy, asked.ignore_specks, deadline);
      response.violations = findDiscViolations(request.plan, geometry, raster, deadline);
    } else {
      const PlanningGrid grid =
          makePlanningGrid(*map, asked.occupancy, asked.ignore_specks, deadline);
      response.violations = findViolations(request.plan, grid);
    }
  } catch (const Interrupted&) {
    response.violations.emplace_back(stop_->requested() ? "not judged: the node is shutting down"
                                                        : "not judged: the time limit passed");
  } catch (const std::exception& error) {
    response.violations.emplace_back(error.what());
  }
  response.valid = response.violations.empty();
  return true;
}

bool PlanServices::checkSolvable(CheckSolvable::Request& request,
                                 CheckSolvable::Response& response) const {
  Outcome outcome = Outcome::kInternalError;
  try {
    const auto goal = boost::make_shared<PlanPathsGoal>();
    goal->map = std::move(request.map);
    goal->robots = std::move(request.robots);
    goal->options = request.options;
    const GoalOptions options = goal_planner_.readOptions(goal->options);
    const Deadline deadline(options.plan.time_limit_sec, stop_);
    const PreparedGoal prepared = goal_planner_.prepare(goal, options, deadline);
    const SolvabilityVerdict verdict = split_mapf::checkSolvable(prepared.instance, deadline);
    outcome = outcomeOf(verdict.answer);
    if (outcome == Outcome::kTimeout) throw PreparationStopped("while a proof was being searched");
    response.reason = explain(verdict);
    if (outcome == Outcome::kUnsolvable) {
      UnsolvableAnswer proof = describeUnsolvable(refusalsOf(prepared, verdict, deadline),
                                                  prepared.robots.ids, prepared.grid);
      response.reason = std::move(proof.message);
      response.faults = std::move(proof.faults);
    }
  } catch (const PreparationStopped& stop) {
    const bool ending = stop_->requested();
    outcome = ending ? Outcome::kCancelled : Outcome::kTimeout;
    response.reason =
        ending ? "undecided: the node is shutting down"
               : std::string("undecided within the time limit, which passed ") + stop.what();
  } catch (const GoalError& error) {
    outcome = error.outcome();
    response.reason = error.what();
    response.faults = error.faults();
  } catch (const std::bad_alloc&) {
    outcome = Outcome::kMemoryLimit;
    response.reason = "memory ran out; a smaller map needs less";
  } catch (const std::exception& error) {
    response.reason = error.what();
  }
  response.outcome = codeOf(outcome);
  response.solvable = outcome == Outcome::kSucceeded;
  return true;
}

bool PlanServices::listSolvers(ListSolvers::Request& /*request*/,
                               ListSolvers::Response& response) const {
  response.names.emplace_back("auto");
  response.descriptions.emplace_back(
      "chooses a solver by what the instance is like; split auto makes no split");
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
