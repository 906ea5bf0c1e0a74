#include "ros/convert/fleet_options.h"

#include <algorithm>
#include <array>

#include "ros/convert/parameter_reader.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/pipeline/rolling.h"

namespace split_mapf {
namespace {

constexpr std::int64_t kMostVisits = 1000;
constexpr std::int64_t kMostTasks = 1000000;
constexpr double kMostSeconds = 1e9;
// Robots stand, or run out of promises, while they wait for a plan.
constexpr double kTimeLimitSec = 10;

// Of the planner node, without a meaning here: a fleet is planned anew for the sum of costs.
constexpr std::array<const char*, 6> kOfPlannerAlone = {
    "objective", "max_queued_goals", "publish_paths", "fill_poses", "solver_plugins", "workers"};

bool readChoice(ParameterReader& reader, const std::string& name, const char* yes, const char* no,
                bool chosen) {
  std::string value = chosen ? yes : no;
  reader.read(name, value);
  if (value == yes) return true;
  if (value == no) return false;
  throw OptionError("parameter ~" + name + " is " + quote(value) + "; " + yes + " or " + no +
                    " is expected");
}

void readAll(ParameterReader& reader, FleetServerOptions& options) {
  FleetOptions& fleet = options.fleet;
  fleet.replans = readChoice(reader, "policy", "replan", "graph", fleet.replans);
  fleet.joint_rings = readChoice(reader, "rings", "joint", "avoid", fleet.joint_rings);
  reader.read("replan_period", fleet.replan_period_sec);
  reader.read("replan_budget", options.replan_budget_sec);
  reader.read("time_limit", options.server.goal.plan.time_limit_sec);
  reader.read("turn_time", fleet.turn_sec);
  reader.read("progress_timeout", fleet.progress_timeout_sec);
  reader.read("obstacle_time", fleet.obstacle_time_sec);
  reader.read("straighten", options.server.goal.plan.straighten);
  fleet.release_ahead = static_cast<std::uint32_t>(
      reader.readInteger("release_ahead", fleet.release_ahead, {1, kMostVisits}));
  options.route_ahead = static_cast<std::uint32_t>(
      reader.readInteger("route_ahead", options.route_ahead, {0, kMostVisits}));
  reader.read("execution_file", options.execution_file);
  options.window = static_cast<std::uint32_t>(
      reader.readInteger("window", options.window, {1, RollingOptions::kMostWindow}));
  options.max_active = static_cast<std::uint32_t>(
      reader.readInteger("max_active", options.max_active, {0, kMostTasks}));
  options.max_tasks = static_cast<std::uint32_t>(
      reader.readInteger("max_tasks", options.max_tasks, {1, kMostTasks}));
  reader.read("join_reporting", options.join_reporting);
}

}  // namespace

FleetServerOptions readFleetOptions(const XmlRpc::XmlRpcValue& parameters,
                                    const std::string& default_file) {
  FleetServerOptions options;
  options.server = readServerOptions(parameters);
  options.server.goal.plan.straighten = true;
  options.server.goal.plan.time_limit_sec = kTimeLimitSec;
  options.execution_file = default_file;
  ParameterReader reader(parameters);
  readAll(reader, options);
  options.robot_radius_m = options.server.goal.roadmap.robot_radius_m;
  options.server.goal.plan.objective = Objective::kSumOfCosts;
  if (!(options.replan_budget_sec >= 0 && options.replan_budget_sec <= kMostSeconds)) {
    throw OptionError("replan_budget " + numeral(options.replan_budget_sec) +
                      " s is out of range: 0 to " + numeral(kMostSeconds) + " is expected");
  }
  requireValid(options.fleet);
  return options;
}

std::vector<std::string> findUnknownFleetParameters(const XmlRpc::XmlRpcValue& parameters) {
  std::vector<std::string> unknown = findUnknownParameters(parameters);
  FleetServerOptions ignored;
  ParameterReader reader(parameters);
  readAll(reader, ignored);
  const std::vector<std::string> not_of_fleet = reader.unreadNames();
  const auto is_of_fleet = [&](const std::string& name) {
    return name == "execute" || name == "move" ||
           std::find(not_of_fleet.begin(), not_of_fleet.end(), name) == not_of_fleet.end();
  };
  unknown.erase(std::remove_if(unknown.begin(), unknown.end(), is_of_fleet), unknown.end());
  for (const std::string& name : ParameterReader(parameters).unreadNames()) {
    const auto* const end = kOfPlannerAlone.end();
    if (std::find(kOfPlannerAlone.begin(), end, name) != end) unknown.push_back(name);
  }
  return unknown;
}

}  // namespace split_mapf
