#include "ros/convert/options_loader.h"

#include <algorithm>
#include <limits>
#include <set>

#include "ros/convert/parameter_reader.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

constexpr std::uint64_t kMebibyte = 1ULL << 20U;
constexpr std::int64_t kMaxUint32 = std::numeric_limits<std::int32_t>::max();

// [s] Years; what lies beyond is a mistake of units.
constexpr double kMostSeconds = 1e9;
// [m] A thousand kilometres.
constexpr double kMostMetres = 1e6;
// [s] A microsecond and eleven days. That a whole plan fits into ROS time is asked when it is
// known.
constexpr double kLeastStep = 1e-6;
constexpr double kMostStep = 1e6;
constexpr double kMostSpeed = 1e6;  // [m/s]
constexpr double kRounding = 1e-9;

/// Refuses what is no number, too.
void requireWithin(double value, const std::string& name, double least, double most) {
  if (value >= least && value <= most) return;
  throw OptionError(name + " " + numeral(value) + " is out of range: a number from " +
                    numeral(least) + " to " + numeral(most) + " is expected");
}

/// 0 = the server's value, a negative number = explicitly zero.
template <typename T>
T choose(T asked, T default_value) {
  if (asked == 0) return default_value;
  return asked < 0 ? T{0} : asked;
}

void checkThreshold(int threshold) {
  if (threshold < 1 || threshold > 100) {
    throw OptionError("occupied_threshold " + std::to_string(threshold) +
                      " is out of range: 1 to 100 [%] is expected");
  }
}

bool isFreeWhenUnknown(std::uint8_t unknown_space, bool default_value) {
  switch (unknown_space) {
    case PlanOptions::UNKNOWN_SPACE_DEFAULT:
      return default_value;
    case PlanOptions::UNKNOWN_SPACE_BLOCKED:
      return false;
    case PlanOptions::UNKNOWN_SPACE_FREE:
      return true;
    default:
      throw OptionError("unknown_space " + std::to_string(unknown_space) +
                        " is out of range: 0 (the server's), 1 (blocked) or 2 (free) is expected");
  }
}

bool areOn(std::uint8_t passages, bool default_value) {
  if (passages > PlanOptions::PASSAGES_ON) {
    throw OptionError("passages " + std::to_string(passages) +
                      " is out of range: 0 (the server's), 1 (off) or 2 (on) is expected");
  }
  if (passages == PlanOptions::PASSAGES_DEFAULT) return default_value;
  return passages == PlanOptions::PASSAGES_ON;
}

void readPlanRequest(ParameterReader& reader, PlanRequest& plan) {
  reader.read("solver", plan.solver);
  reader.read("solver_options", plan.solver_options);
  reader.read("split", plan.split);
  reader.read("split_options", plan.split_options);
  std::string objective = toString(plan.objective);
  reader.read("objective", objective);
  plan.objective = parseObjective(objective);
  reader.read("suboptimality", plan.suboptimality);
  reader.read("time_limit", plan.time_limit_sec);
  reader.read("refine_time", plan.refine_sec);
  plan.seed = static_cast<std::uint64_t>(
      reader.readInteger("seed", static_cast<std::int64_t>(plan.seed), {0, kMaxUint32}));
  plan.threads = static_cast<std::uint32_t>(reader.readInteger("threads", plan.threads, {0, 1024}));
  const auto mebibytes = static_cast<std::int64_t>(plan.table_bytes / kMebibyte);
  plan.table_bytes = kMebibyte * static_cast<std::uint64_t>(reader.readInteger(
                                     "table_memory", mebibytes, {0, kMaxUint32}));
}

void readGoalOptions(ParameterReader& reader, GoalOptions& options) {
  readPlanRequest(reader, options.plan);
  reader.read("robot_radius", options.roadmap.robot_radius_m);
  reader.read("cell_size", options.roadmap.cell_size_m);
  reader.read("clearance", options.roadmap.clearance_m);
  reader.read("snap_distance", options.snap_distance_m);
  reader.read("passages", options.roadmap.passages);
  options.ignore_specks = static_cast<std::uint32_t>(
      reader.readInteger("ignore_specks", options.ignore_specks, {0, kMaxUint32}));
  reader.read("robot_speed", options.robot_speed_mps);
  const std::int64_t unknown_default = options.occupancy.unknown_is_free
                                           ? PlanOptions::UNKNOWN_SPACE_FREE
                                           : PlanOptions::UNKNOWN_SPACE_BLOCKED;
  options.occupancy.unknown_is_free =
      reader.readInteger("unknown_space", unknown_default,
                         {PlanOptions::UNKNOWN_SPACE_BLOCKED, PlanOptions::UNKNOWN_SPACE_FREE}) ==
      PlanOptions::UNKNOWN_SPACE_FREE;
  options.occupancy.occupied_threshold = static_cast<int>(
      reader.readInteger("occupied_threshold", options.occupancy.occupied_threshold, {1, 100}));
  // Who says a speed and no duration asks for the one that belongs to it, as in a goal.
  if (options.robot_speed_mps > 0 && !reader.has("step_duration")) options.step_duration_sec = 0;
  reader.read("step_duration", options.step_duration_sec);
  reader.read("fill_poses", options.fill_poses);
}

ServerOptions readAll(ParameterReader& reader) {
  ServerOptions options;
  readGoalOptions(reader, options.goal);
  options.max_queued_goals = static_cast<std::uint32_t>(
      reader.readInteger("max_queued_goals", options.max_queued_goals, {1, 1000}));
  reader.read("publish_paths", options.publish_paths);
  reader.read("map_file", options.map_file);
  reader.read("solver_plugins", options.solver_plugins);
  reader.read("workers", options.workers);
  return options;
}

}  // namespace

void requireInRange(const GoalOptions& options) {
  requireWithin(options.plan.time_limit_sec, "time_limit", 0, kMostSeconds);
  requireWithin(options.plan.refine_sec, "refine_time", 0, kMostSeconds);
  requireWithin(options.roadmap.robot_radius_m, "robot_radius", 0, kMostMetres);
  requireWithin(options.roadmap.cell_size_m, "cell_size", 0, kMostMetres);
  requireWithin(options.roadmap.clearance_m, "clearance", 0, kMostMetres);
  requireWithin(options.snap_distance_m, "snap_distance", 0, kMostMetres);
  requireWithin(options.robot_speed_mps, "robot_speed", 0, kMostSpeed);
  if (options.step_duration_sec != 0) {
    requireWithin(options.step_duration_sec, "step_duration", kLeastStep, kMostStep);
  }
  checkThreshold(options.occupancy.occupied_threshold);
}

ServerOptions readServerOptions(const XmlRpc::XmlRpcValue& parameters) {
  ParameterReader reader(parameters);
  ServerOptions options = readAll(reader);
  requireInRange(options.goal);
  return options;
}

std::vector<std::string> findUnknownParameters(const XmlRpc::XmlRpcValue& parameters) {
  ParameterReader reader(parameters);
  readAll(reader);
  const std::set<std::string> of_libraries = {"actionlib_server_pub_queue_size",
                                              "actionlib_server_sub_queue_size",
                                              "actionlib_status_frequency",
                                              "diagnostic_period",
                                              "diagnostic_updater_use_fqn",
                                              "plan_paths",
                                              "status_list_timeout"};
  std::vector<std::string> unknown;
  for (const std::string& name : reader.unreadNames()) {
    if (of_libraries.count(name) == 0) unknown.push_back(name);
  }
  return unknown;
}

GoalOptions mergeOptions(const PlanOptions& asked, const GoalOptions& defaults) {
  GoalOptions options = defaults;
  PlanRequest& plan = options.plan;
  if (!asked.solver.empty() && asked.solver != plan.solver) {
    plan.solver = asked.solver;
    plan.solver_options.clear();
  }
  if (!asked.solver_options.empty()) plan.solver_options = asked.solver_options;
  if (!asked.split.empty()) plan.split = asked.split;
  if (!asked.split_options.empty()) plan.split_options = asked.split_options;
  if (!asked.objective.empty()) plan.objective = parseObjective(asked.objective);
  plan.suboptimality = choose(asked.suboptimality, plan.suboptimality);
  plan.time_limit_sec = choose(asked.time_limit, plan.time_limit_sec);
  plan.refine_sec = choose(asked.refine_time, plan.refine_sec);
  if (asked.seed != 0) plan.seed = asked.seed;
  if (asked.threads != 0) plan.threads = asked.threads;
  options.roadmap.robot_radius_m = choose(asked.robot_radius, options.roadmap.robot_radius_m);
  options.roadmap.cell_size_m = choose(asked.cell_size, options.roadmap.cell_size_m);
  options.roadmap.clearance_m = choose(asked.clearance, options.roadmap.clearance_m);
  options.snap_distance_m = choose(asked.snap_distance, options.snap_distance_m);
  options.roadmap.passages = areOn(asked.passages, options.roadmap.passages);
  if (asked.ignore_specks != 0) {
    options.ignore_specks = static_cast<std::uint32_t>(std::max(0, asked.ignore_specks));
  }
  options.occupancy.unknown_is_free =
      isFreeWhenUnknown(asked.unknown_space, options.occupancy.unknown_is_free);
  options.occupancy.occupied_threshold =
      choose<int>(asked.occupied_threshold, options.occupancy.occupied_threshold);
  options.robot_speed_mps = choose(asked.robot_speed, options.robot_speed_mps);
  options.step_duration_sec = choose(asked.step_duration, options.step_duration_sec);
  // Who says a speed and no duration asks for the one that belongs to it.
  if (asked.robot_speed > 0 && asked.step_duration == 0) options.step_duration_sec = 0;
  options.fill_poses = options.fill_poses || asked.fill_poses;
  requireInRange(options);
  return options;
}

PlanOptions toMessage(const GoalOptions& options) {
  const auto spelled = [](auto value) { return value == 0 ? decltype(value){-1} : value; };
  const PlanRequest& plan = options.plan;
  PlanOptions message;
  message.solver = plan.solver;
  message.solver_options = plan.solver_options;
  message.split = plan.split;
  message.split_options = plan.split_options;
  message.objective = toString(plan.objective);
  message.suboptimality = plan.suboptimality;
  message.time_limit = spelled(plan.time_limit_sec);
  message.refine_time = spelled(plan.refine_sec);
  message.seed = static_cast<std::uint32_t>(plan.seed);
  message.threads = plan.threads;
  message.robot_radius = spelled(options.roadmap.robot_radius_m);
  message.cell_size = spelled(options.roadmap.cell_size_m);
  message.clearance = spelled(options.roadmap.clearance_m);
  message.snap_distance = spelled(options.snap_distance_m);
  message.passages =
      options.roadmap.passages ? PlanOptions::PASSAGES_ON : PlanOptions::PASSAGES_OFF;
  message.ignore_specks = spelled(static_cast<std::int32_t>(options.ignore_specks));
  message.unknown_space = options.occupancy.unknown_is_free ? PlanOptions::UNKNOWN_SPACE_FREE
                                                            : PlanOptions::UNKNOWN_SPACE_BLOCKED;
  message.occupied_threshold = static_cast<std::int8_t>(options.occupancy.occupied_threshold);
  message.robot_speed = spelled(options.robot_speed_mps);
  message.step_duration = spelled(options.step_duration_sec);
  message.fill_poses = static_cast<std::uint8_t>(options.fill_poses);
  return message;
}

double stepDurationOf(const GoalOptions& options, double longest_step_m) {
  const double speed = options.robot_speed_mps;
  const double needed = speed > 0 ? longest_step_m / speed : 1;
  if (options.step_duration_sec == 0) {
    requireWithin(needed,
                  "step_duration (longest step " + numeral(longest_step_m) + " m / robot_speed " +
                      numeral(speed) + " m/s)",
                  kLeastStep, kMostStep);
    return needed;
  }
  if (speed > 0 && options.step_duration_sec < needed * (1 - kRounding)) {
    throw OptionError("step_duration " + numeral(options.step_duration_sec) +
                      " s is too short: the longest step of " + numeral(longest_step_m) +
                      " m takes " + numeral(needed) + " s at robot_speed " + numeral(speed) +
                      " m/s (0 derives it)");
  }
  return options.step_duration_sec;
}

}  // namespace split_mapf
