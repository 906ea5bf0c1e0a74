#include "ros/convert/options_loader.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <functional>
#include <limits>

#include "ros/replay/replay.h"
#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

using XmlRpc::XmlRpcValue;

XmlRpcValue listOf(const std::vector<std::string>& texts) {
  XmlRpcValue list;
  list.setSize(static_cast<int>(texts.size()));
  for (std::size_t i = 0; i < texts.size(); ++i) list[static_cast<int>(i)] = texts[i];
  return list;
}

/// A scalar or list of a parameter file, with the type that rosparam would give it.
XmlRpcValue parameterOf(const YAML::Node& node) {
  if (node.IsSequence()) return listOf(node.as<std::vector<std::string>>());
  const auto text = node.as<std::string>();
  int whole = 0;
  double number = 0;
  bool truth = false;
  if (node.Tag() == "!") return XmlRpcValue(text);  // quoted
  if (YAML::convert<int>::decode(node, whole)) return XmlRpcValue(whole);
  if (YAML::convert<double>::decode(node, number)) return XmlRpcValue(number);
  if (YAML::convert<bool>::decode(node, truth)) return XmlRpcValue(truth);
  return XmlRpcValue(text);
}

XmlRpcValue readParameterFile(const std::string& path) {
  XmlRpcValue parameters;
  for (const auto& entry : YAML::LoadFile(path)) {
    parameters[entry.first.as<std::string>()] = parameterOf(entry.second);
  }
  return parameters;
}

void expectEqual(const PlanRequest& a, const PlanRequest& b) {
  EXPECT_EQ(a.solver, b.solver);
  EXPECT_EQ(a.solver_options, b.solver_options);
  EXPECT_EQ(a.split, b.split);
  EXPECT_EQ(a.split_options, b.split_options);
  EXPECT_EQ(a.objective, b.objective);
  EXPECT_EQ(a.suboptimality, b.suboptimality);
  EXPECT_EQ(a.time_limit_sec, b.time_limit_sec);
  EXPECT_EQ(a.refine_sec, b.refine_sec);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.threads, b.threads);
  EXPECT_EQ(a.table_bytes, b.table_bytes);
}

void expectEqual(const GoalOptions& a, const GoalOptions& b) {
  expectEqual(a.plan, b.plan);
  EXPECT_EQ(a.occupancy.occupied_threshold, b.occupancy.occupied_threshold);
  EXPECT_EQ(a.occupancy.unknown_is_free, b.occupancy.unknown_is_free);
  EXPECT_EQ(a.roadmap.robot_radius_m, b.roadmap.robot_radius_m);
  EXPECT_EQ(a.roadmap.cell_size_m, b.roadmap.cell_size_m);
  EXPECT_EQ(a.roadmap.clearance_m, b.roadmap.clearance_m);
  EXPECT_EQ(a.snap_distance_m, b.snap_distance_m);
  EXPECT_EQ(a.roadmap.passages, b.roadmap.passages);
  EXPECT_EQ(a.ignore_specks, b.ignore_specks);
  EXPECT_EQ(a.robot_speed_mps, b.robot_speed_mps);
  EXPECT_EQ(a.step_duration_sec, b.step_duration_sec);
  EXPECT_EQ(a.fill_poses, b.fill_poses);
}

/// Every parameter at a value that is not its default.
XmlRpcValue unusualParameters() {
  XmlRpcValue p;
  p["solver"] = "prioritized";
  p["solver_options"] = listOf({"order=random"});
  p["split"] = "4t";
  p["split_options"] = listOf({"variant=makespan"});
  p["objective"] = "sum_of_costs";
  p["suboptimality"] = 2;
  p["time_limit"] = 7.5;
  p["refine_time"] = 2.5;
  p["seed"] = 42;
  p["threads"] = 3;
  p["table_memory"] = 100;
  p["robot_radius"] = 0.25;
  p["cell_size"] = 0.5;
  p["clearance"] = 0.05;
  p["snap_distance"] = 1.5;
  p["passages"] = false;
  p["ignore_specks"] = 2;
  p["robot_speed"] = 0.75;
  p["unknown_space"] = 2;
  p["occupied_threshold"] = 50;
  p["step_duration"] = 0.2;
  p["fill_poses"] = true;
  p["max_queued_goals"] = 2;
  p["publish_paths"] = true;
  p["map_file"] = "some.map";
  p["workers"] = "nats://fleet@host:4222";
  return p;
}

TEST(ServerOptions, HaveTheDefaultsOfTheInterface) {
  const ServerOptions options = readServerOptions(XmlRpcValue());
  EXPECT_EQ(options.goal.plan.solver, "auto");
  EXPECT_EQ(options.goal.plan.split, "auto");
  EXPECT_EQ(options.goal.plan.objective, Objective::kMakespan);
  EXPECT_EQ(options.goal.plan.suboptimality, 1.5);
  EXPECT_EQ(options.goal.plan.time_limit_sec, 60);
  EXPECT_EQ(options.goal.plan.refine_sec, 0);
  EXPECT_EQ(options.goal.plan.seed, 0U);
  EXPECT_EQ(options.goal.plan.threads, 0U);
  EXPECT_EQ(options.goal.plan.table_bytes, 0U);
  EXPECT_EQ(options.goal.roadmap.robot_radius_m, 0);
  EXPECT_EQ(options.goal.roadmap.cell_size_m, 0);
  EXPECT_FALSE(options.goal.occupancy.unknown_is_free);
  EXPECT_EQ(options.goal.occupancy.occupied_threshold, 65);
  EXPECT_EQ(options.goal.step_duration_sec, 1);
  EXPECT_EQ(options.max_queued_goals, 8U);
  EXPECT_FALSE(options.publish_paths);
  EXPECT_EQ(options.workers, "");
}

TEST(ServerOptions, AreWrittenInTheConfigurationFileAsTheyAre) {
  const XmlRpcValue file = readParameterFile("config/planner.yaml");
  const ServerOptions options = readServerOptions(file);
  const ServerOptions defaults;
  expectEqual(options.goal, defaults.goal);
  EXPECT_EQ(options.max_queued_goals, defaults.max_queued_goals);
  EXPECT_EQ(options.publish_paths, defaults.publish_paths);
  EXPECT_EQ(options.map_file, defaults.map_file);
  EXPECT_EQ(options.workers, defaults.workers);
  EXPECT_TRUE(findUnknownParameters(file).empty());
  // Nothing is left out of the file.
  for (const auto& entry : unusualParameters())
    EXPECT_TRUE(file.hasMember(entry.first)) << entry.first;
}

TEST(ReplayOptions, AreWrittenInTheConfigurationFileAsTheyAre) {
  XmlRpcValue file = readParameterFile("config/replay.yaml");
  EXPECT_EQ(file.size(), 9);
  const ReplayOptions options = readReplayOptions(file);
  const ReplayOptions defaults;
  EXPECT_EQ(options.style.robot_size_cells, defaults.style.robot_size_cells);
  EXPECT_EQ(options.style.trail_steps, defaults.style.trail_steps);
  EXPECT_EQ(options.style.goals, defaults.style.goals);
  EXPECT_EQ(options.style.labels, defaults.style.labels);
  EXPECT_EQ(options.rate_hz, defaults.rate_hz);
  EXPECT_EQ(options.speed, defaults.speed);
  EXPECT_EQ(options.loop, defaults.loop);
  EXPECT_EQ(options.wait_for_viewer, defaults.wait_for_viewer);
  EXPECT_EQ(options.grid_frame, defaults.grid_frame);
}

TEST(ServerOptions, ASpeedAloneRefusedAllGoalsWithLongerSteps) {
  XmlRpcValue p;
  p["robot_speed"] = 0.5;
  const GoalOptions derived = mergeOptions({}, readServerOptions(p).goal);
  EXPECT_EQ(stepDurationOf(derived, 1.2), 2.4);
  p["step_duration"] = 3;
  EXPECT_EQ(stepDurationOf(readServerOptions(p).goal, 1.2), 3);
}

TEST(ServerOptions, ReadEveryParameter) {
  const ServerOptions options = readServerOptions(unusualParameters());
  EXPECT_EQ(options.goal.plan.solver, "prioritized");
  EXPECT_EQ(options.goal.plan.solver_options, std::vector<std::string>{"order=random"});
  EXPECT_EQ(options.goal.plan.split, "4t");
  EXPECT_EQ(options.goal.plan.split_options, std::vector<std::string>{"variant=makespan"});
  EXPECT_EQ(options.goal.plan.objective, Objective::kSumOfCosts);
  EXPECT_EQ(options.goal.plan.suboptimality, 2);
  EXPECT_EQ(options.goal.plan.time_limit_sec, 7.5);
  EXPECT_EQ(options.goal.plan.refine_sec, 2.5);
  EXPECT_EQ(options.goal.plan.seed, 42U);
  EXPECT_EQ(options.goal.plan.threads, 3U);
  EXPECT_EQ(options.goal.roadmap.robot_radius_m, 0.25);
  EXPECT_EQ(options.goal.roadmap.cell_size_m, 0.5);
  EXPECT_EQ(options.goal.roadmap.clearance_m, 0.05);
  EXPECT_EQ(options.goal.snap_distance_m, 1.5);
  EXPECT_FALSE(options.goal.roadmap.passages);
  EXPECT_EQ(options.goal.ignore_specks, 2U);
  EXPECT_EQ(options.goal.robot_speed_mps, 0.75);
  EXPECT_TRUE(options.goal.occupancy.unknown_is_free);
  EXPECT_EQ(options.goal.occupancy.occupied_threshold, 50);
  EXPECT_EQ(options.goal.step_duration_sec, 0.2);
  EXPECT_TRUE(options.goal.fill_poses);
  EXPECT_EQ(options.max_queued_goals, 2U);
  EXPECT_TRUE(options.publish_paths);
  EXPECT_EQ(options.map_file, "some.map");
  EXPECT_EQ(options.workers, "nats://fleet@host:4222");
  EXPECT_TRUE(findUnknownParameters(unusualParameters()).empty());
}

TEST(ServerOptions, NoticeMisspeltParameters) {
  XmlRpcValue parameters = unusualParameters();
  parameters["time_limt"] = 3;
  parameters["diagnostic_period"] = 1.0;
  EXPECT_EQ(findUnknownParameters(parameters), std::vector<std::string>{"time_limt"});
}

TEST(ServerOptions, NameTheParameterThatIsWrong) {
  const std::vector<std::pair<std::string, XmlRpcValue>> bad = {
      {"solver", XmlRpcValue(3)},
      {"solver_options", XmlRpcValue("order=random")},
      {"split_options", XmlRpcValue(1)},
      {"objective", XmlRpcValue("speed")},
      {"suboptimality", XmlRpcValue("high")},
      {"time_limit", XmlRpcValue(-1.0)},
      {"time_limit", XmlRpcValue(std::numeric_limits<double>::quiet_NaN())},
      {"refine_time", XmlRpcValue(-2)},
      {"seed", XmlRpcValue(-1)},
      {"seed", XmlRpcValue(1.5)},
      {"threads", XmlRpcValue(-1)},
      {"robot_radius", XmlRpcValue(-0.1)},
      {"cell_size", XmlRpcValue(-0.1)},
      {"unknown_space", XmlRpcValue(0)},
      {"unknown_space", XmlRpcValue(3)},
      {"occupied_threshold", XmlRpcValue(0)},
      {"occupied_threshold", XmlRpcValue(101)},
      {"step_duration", XmlRpcValue(-1)},
      {"clearance", XmlRpcValue(-0.1)},
      {"snap_distance", XmlRpcValue("near")},
      {"passages", XmlRpcValue(2)},
      {"ignore_specks", XmlRpcValue(-1)},
      {"robot_speed", XmlRpcValue(-1)},
      {"fill_poses", XmlRpcValue(1)},
      {"max_queued_goals", XmlRpcValue(0)},
      {"publish_paths", XmlRpcValue("yes")},
      {"map_file", XmlRpcValue(false)},
      {"workers", XmlRpcValue(4222)},
  };
  for (const auto& [name, value] : bad) {
    XmlRpcValue parameters;
    parameters[name] = value;
    try {
      readServerOptions(parameters);
      ADD_FAILURE() << name << " accepted: " << value.toXml();
    } catch (const OptionError& error) {
      const std::string expected = name == "objective" ? "speed" : name;
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  }
}

TEST(MergeOptions, LeavesWhatIsOpenToTheServer) {
  const GoalOptions server = readServerOptions(unusualParameters()).goal;
  expectEqual(mergeOptions(PlanOptions(), server), server);
}

TEST(MergeOptions, TakesWhatTheGoalSays) {
  PlanOptions asked;
  asked.solver = "ecbs";
  asked.solver_options = {"a=b"};
  asked.split = "none";
  asked.split_options = {"c=d"};
  asked.objective = "makespan";
  asked.suboptimality = 1.1;
  asked.time_limit = 3;
  asked.refine_time = 1;
  asked.seed = 7;
  asked.threads = 1;
  asked.robot_radius = 0.1;
  asked.cell_size = 1;
  asked.clearance = 0.02;
  asked.snap_distance = 2;
  asked.passages = PlanOptions::PASSAGES_OFF;
  asked.ignore_specks = 3;
  asked.robot_speed = 0.5;
  asked.unknown_space = PlanOptions::UNKNOWN_SPACE_BLOCKED;
  asked.occupied_threshold = 99;
  asked.step_duration = 4;
  asked.fill_poses = true;
  const GoalOptions options = mergeOptions(asked, readServerOptions(unusualParameters()).goal);
  EXPECT_EQ(options.plan.solver, "ecbs");
  EXPECT_EQ(options.plan.solver_options, std::vector<std::string>{"a=b"});
  EXPECT_EQ(options.plan.split, "none");
  EXPECT_EQ(options.plan.split_options, std::vector<std::string>{"c=d"});
  EXPECT_EQ(options.plan.objective, Objective::kMakespan);
  EXPECT_EQ(options.plan.suboptimality, 1.1);
  EXPECT_EQ(options.plan.time_limit_sec, 3);
  EXPECT_EQ(options.plan.refine_sec, 1);
  EXPECT_EQ(options.plan.seed, 7U);
  EXPECT_EQ(options.plan.threads, 1U);
  EXPECT_EQ(options.roadmap.robot_radius_m, 0.1);
  EXPECT_EQ(options.roadmap.cell_size_m, 1);
  EXPECT_EQ(options.roadmap.clearance_m, 0.02);
  EXPECT_EQ(options.snap_distance_m, 2);
  EXPECT_FALSE(options.roadmap.passages);
  EXPECT_EQ(options.ignore_specks, 3U);
  EXPECT_EQ(options.robot_speed_mps, 0.5);
  EXPECT_FALSE(options.occupancy.unknown_is_free);
  EXPECT_EQ(options.occupancy.occupied_threshold, 99);
  EXPECT_EQ(options.step_duration_sec, 4);
  EXPECT_TRUE(options.fill_poses);
}

TEST(MergeOptions, TakesANegativeNumberForZero) {
  PlanOptions asked;
  asked.time_limit = -1;
  asked.refine_time = -0.5;
  asked.robot_radius = -1;
  asked.cell_size = -3;
  asked.suboptimality = -1;
  const GoalOptions options = mergeOptions(asked, readServerOptions(unusualParameters()).goal);
  EXPECT_EQ(options.plan.time_limit_sec, 0);
  EXPECT_EQ(options.plan.refine_sec, 0);
  EXPECT_EQ(options.roadmap.robot_radius_m, 0);
  EXPECT_EQ(options.roadmap.cell_size_m, 0);
  EXPECT_EQ(options.plan.suboptimality, 0);
}

TEST(MergeOptions, ReadsWhatAResultTellsWhateverTheServersOptionsAre) {
  GoalOptions unusual = readServerOptions(unusualParameters()).goal;
  GoalOptions usual;
  // What a message cannot say: 0 and empty lists are the server's, poses can only be asked for.
  usual.plan.seed = unusual.plan.seed + 1;
  usual.plan.threads = 1;
  usual.plan.split_options = {"compaction=false"};
  unusual.fill_poses = false;
  // No plan depends on it, so nobody asks for it.
  usual.plan.table_bytes = unusual.plan.table_bytes;
  expectEqual(mergeOptions(toMessage(usual), unusual), usual);
  expectEqual(mergeOptions(toMessage(unusual), usual), unusual);
}

TEST(MergeOptions, ASpeedInTheGoalDerivesTheStep) {
  PlanOptions asked;
  asked.robot_speed = 0.5;
  const GoalOptions derived = mergeOptions(asked, {});
  EXPECT_EQ(stepDurationOf(derived, 1.2), 2.4);
  asked.step_duration = 1;
  EXPECT_THROW(stepDurationOf(mergeOptions(asked, {}), 1.2), OptionError);
  asked.step_duration = 3;
  EXPECT_EQ(stepDurationOf(mergeOptions(asked, {}), 1.2), 3);
  PlanOptions zero;
  zero.step_duration = -1;
  EXPECT_EQ(stepDurationOf(mergeOptions(zero, {}), 1.2), 1) << "no speed is known";
  EXPECT_EQ(stepDurationOf({}, 1.2), 1);
}

TEST(MergeOptions, KeepsTheServersSolverOptionsToTheServersSolver) {
  const GoalOptions server = readServerOptions(unusualParameters()).goal;
  PlanOptions asked;
  asked.solver = "ecbs";
  EXPECT_TRUE(mergeOptions(asked, server).plan.solver_options.empty());
  asked.solver = server.plan.solver;
  EXPECT_EQ(mergeOptions(asked, server).plan.solver_options, server.plan.solver_options);
}

TEST(MergeOptions, RefusesValuesOutOfRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::function<void(PlanOptions&)>> bad = {
      [](PlanOptions& o) { o.objective = "speed"; },
      [](PlanOptions& o) { o.unknown_space = 3; },
      [](PlanOptions& o) { o.occupied_threshold = 101; },
      [](PlanOptions& o) { o.occupied_threshold = -1; },
      [](PlanOptions& o) { o.passages = 3; },
      [](PlanOptions& o) { o.robot_speed = 1e300; },
      [&](PlanOptions& o) { o.clearance = nan; },
      [&](PlanOptions& o) { o.snap_distance = nan; },
      [](PlanOptions& o) { o.step_duration = 1e9; },
      [](PlanOptions& o) { o.step_duration = 1e-300; },
      [](PlanOptions& o) { o.time_limit = 1e300; },
      [](PlanOptions& o) { o.refine_time = 1e300; },
      [](PlanOptions& o) { o.robot_radius = 1e300; },
      [](PlanOptions& o) { o.cell_size = 1e300; },
      [&](PlanOptions& o) { o.step_duration = nan; },
      [&](PlanOptions& o) { o.time_limit = nan; },
      [&](PlanOptions& o) { o.refine_time = nan; },
      [&](PlanOptions& o) { o.robot_radius = nan; },
      [](PlanOptions& o) { o.cell_size = std::numeric_limits<double>::infinity(); },
  };
  for (std::size_t i = 0; i < bad.size(); ++i) {
    PlanOptions asked;
    bad[i](asked);
    EXPECT_THROW(mergeOptions(asked, GoalOptions()), OptionError) << i;
  }
}

}  // namespace
}  // namespace split_mapf
