#include "ros/server/reconfiguration.h"

#ifdef SPLIT_MAPF_HAS_RECONFIGURE
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <dynamic_reconfigure/server.h>
#include <ros/console.h>
#include <split_mapf/PlannerConfig.h>

#include "split_mapf/core/error.h"
#endif

namespace split_mapf {

#ifdef SPLIT_MAPF_HAS_RECONFIGURE

namespace {

/// Of a value that would be another one where the options keep it. @throws OptionError.
void requireKept(bool is_kept, const std::string& name, int value, const char* expected) {
  if (is_kept) return;
  throw OptionError(name + " " + std::to_string(value) + " is out of range: " + expected +
                    " is expected");
}

/// What the options have no way to say, so that nobody could refuse it later.
void requireKept(const PlannerConfig& config) {
  requireKept(config.seed >= 0, "seed", config.seed, "0 or more");
  requireKept(config.ignore_specks >= 0, "ignore_specks", config.ignore_specks, "0 or more");
  requireKept(config.unknown_space == PlanOptions::UNKNOWN_SPACE_BLOCKED ||
                  config.unknown_space == PlanOptions::UNKNOWN_SPACE_FREE,
              "unknown_space", config.unknown_space, "1 (blocked) or 2 (free)");
}

/// The options with what a configuration says of them; not checked yet.
/// @throws OptionError for what they cannot hold.
GoalOptions withConfig(const PlannerConfig& config, GoalOptions options) {
  requireKept(config);
  PlanRequest& plan = options.plan;
  if (config.solver != plan.solver) plan.solver_options.clear();
  if (config.split != plan.split) plan.split_options.clear();
  plan.solver = config.solver;
  plan.split = config.split;
  plan.objective = parseObjective(config.objective);
  plan.suboptimality = config.suboptimality;
  plan.time_limit_sec = config.time_limit;
  plan.refine_sec = config.refine_time;
  plan.seed = static_cast<std::uint64_t>(config.seed);
  options.roadmap.robot_radius_m = config.robot_radius;
  options.roadmap.cell_size_m = config.cell_size;
  options.roadmap.clearance_m = config.clearance;
  options.snap_distance_m = config.snap_distance;
  options.roadmap.passages = config.passages;
  options.ignore_specks = static_cast<std::uint32_t>(config.ignore_specks);
  options.robot_speed_mps = config.robot_speed;
  options.occupancy.unknown_is_free = config.unknown_space == PlanOptions::UNKNOWN_SPACE_FREE;
  options.occupancy.occupied_threshold = config.occupied_threshold;
  options.step_duration_sec = config.step_duration;
  options.fill_poses = config.fill_poses;
  return options;
}

PlannerConfig configOf(const GoalOptions& options) {
  // It has groups of its own, which nothing else would set.
  PlannerConfig config = PlannerConfig::__getDefault__();
  config.solver = options.plan.solver;
  config.split = options.plan.split;
  config.objective = toString(options.plan.objective);
  config.suboptimality = options.plan.suboptimality;
  config.time_limit = options.plan.time_limit_sec;
  config.refine_time = options.plan.refine_sec;
  config.seed = static_cast<int>(options.plan.seed);
  config.robot_radius = options.roadmap.robot_radius_m;
  config.cell_size = options.roadmap.cell_size_m;
  config.clearance = options.roadmap.clearance_m;
  config.snap_distance = options.snap_distance_m;
  config.passages = options.roadmap.passages;
  config.ignore_specks = static_cast<int>(options.ignore_specks);
  config.robot_speed = options.robot_speed_mps;
  config.unknown_space = options.occupancy.unknown_is_free ? PlanOptions::UNKNOWN_SPACE_FREE
                                                           : PlanOptions::UNKNOWN_SPACE_BLOCKED;
  config.occupied_threshold = options.occupancy.occupied_threshold;
  config.step_duration = options.step_duration_sec;
  config.fill_poses = options.fill_poses;
  return config;
}

/// All values are put on the parameter server, where the next node would take a duration that
/// nobody gave for one that does not fit its speed. 0 means the same, and fits any.
void leaveStepOpen(const ros::NodeHandle& private_node, GoalDefaults& defaults) {
  if (private_node.hasParam("step_duration")) return;
  GoalOptions options = defaults.get();
  options.step_duration_sec = 0;
  defaults.set(std::move(options));
}

}  // namespace

struct Reconfiguration::Server {
  Server(const ros::NodeHandle& of_node, const Planner& to_ask, GoalDefaults& to_change)
      : private_node(of_node), planner(to_ask), defaults(to_change), server(of_node) {
    server.setCallback([this](PlannerConfig& config, std::uint32_t /*level*/) { take(config); });
  }

  /// Leaves in `config` what holds.
  void take(PlannerConfig& config) {
    // The first call comes with what the library read from the parameter server, where a missing
    // value has another meaning to this node.
    if (has_begun) change(config);
    has_begun = true;
    config = configOf(defaults.get());
  }

  void change(const PlannerConfig& config) {
    try {
      const PlanRequest before = defaults.get().plan;
      const GoalOptions wanted = withConfig(config, defaults.get());
      requireInRange(wanted);
      planner.requireValid(wanted.plan);
      defaults.set(wanted);
      forgetList("solver_options", before.solver_options, wanted.plan.solver_options);
      forgetList("split_options", before.split_options, wanted.plan.split_options);
      ROS_INFO("the defaults of goals are reconfigured");
    } catch (const OptionError& error) {
      ROS_ERROR("the defaults of goals stay as they are: %s", error.what());
    }
  }

  /// dynamic_reconfigure writes `solver` and `split` to the parameter server, but no list: the next
  /// node would read the options of the solver before, and refuse to start.
  void forgetList(const std::string& name, const std::vector<std::string>& before,
                  const std::vector<std::string>& now) {
    if (!before.empty() && now.empty()) private_node.setParam(name, now);
  }

  const ros::NodeHandle private_node;
  const Planner& planner;
  GoalDefaults& defaults;
  bool has_begun = false;
  dynamic_reconfigure::Server<PlannerConfig> server;
};

Reconfiguration::Reconfiguration(const ros::NodeHandle& private_node, const Planner& planner,
                                 GoalDefaults& defaults) {
  leaveStepOpen(private_node, defaults);
  server_ = std::make_unique<Server>(private_node, planner, defaults);
}

#else

struct Reconfiguration::Server {};

Reconfiguration::Reconfiguration(const ros::NodeHandle& /*private_node*/,
                                 const Planner& /*planner*/, GoalDefaults& /*defaults*/) {}

#endif

Reconfiguration::~Reconfiguration() = default;

}  // namespace split_mapf
