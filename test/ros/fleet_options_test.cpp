#include "ros/convert/fleet_options.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "ros/one_parameter.h"
#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

using test::parametersOf;

TEST(FleetOptions, HaveTheirDefaults) {
  const FleetServerOptions options = readFleetOptions(XmlRpc::XmlRpcValue(), "kept.json");
  EXPECT_TRUE(options.fleet.replans);
  EXPECT_FALSE(options.fleet.joint_rings);
  EXPECT_EQ(options.execution_file, "kept.json");
  EXPECT_EQ(options.server.goal.plan.objective, Objective::kSumOfCosts);
  EXPECT_EQ(options.server.goal.plan.time_limit_sec, 10);
  EXPECT_EQ(options.replan_budget_sec, 1);
}

TEST(FleetOptions, AreRead) {
  XmlRpc::XmlRpcValue parameters = parametersOf("policy", "graph");
  parameters["rings"] = "joint";
  parameters["release_ahead"] = 4;
  parameters["robot_radius"] = 0.25;
  parameters["execution_file"] = "";
  parameters["replan_budget"] = 0.5;
  parameters["time_limit"] = 3;
  const FleetServerOptions options = readFleetOptions(parameters, "kept.json");
  EXPECT_FALSE(options.fleet.replans);
  EXPECT_TRUE(options.fleet.joint_rings);
  EXPECT_EQ(options.fleet.release_ahead, 4U);
  EXPECT_EQ(options.robot_radius_m, 0.25);
  EXPECT_EQ(options.execution_file, "");
  EXPECT_EQ(options.replan_budget_sec, 0.5);
  EXPECT_EQ(options.server.goal.plan.time_limit_sec, 3);
}

TEST(FleetOptions, NameWhatIsWrong) {
  for (const auto& [name, value] : {std::pair<std::string, XmlRpc::XmlRpcValue>("policy", "hope"),
                                    {"rings", "broken"},
                                    {"release_ahead", 0},
                                    {"replan_period", -1.0},
                                    {"replan_budget", -1.0},
                                    {"time_limit", -1.0},
                                    {"progress_timeout", "soon"}}) {
    try {
      readFleetOptions(parametersOf(name, value), "");
      ADD_FAILURE() << name;
    } catch (const OptionError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
}

TEST(FleetOptions, KnowTheirOwnAndThePlanners) {
  XmlRpc::XmlRpcValue parameters = parametersOf("policy", "graph");
  parameters["solver"] = "lacam";
  EXPECT_TRUE(findUnknownFleetParameters(parameters).empty());
  parameters["polcy"] = "graph";
  EXPECT_EQ(findUnknownFleetParameters(parameters), std::vector<std::string>{"polcy"});
}

TEST(FleetOptions, SayWhichOfThePlannersHaveNoMeaning) {
  XmlRpc::XmlRpcValue parameters = parametersOf("objective", "makespan");
  parameters["time_limit"] = 5.0;
  parameters["workers"] = "nats://host";
  parameters["solver_plugins"][0] = "mine/Fast";
  EXPECT_EQ(findUnknownFleetParameters(parameters),
            (std::vector<std::string>{"objective", "solver_plugins", "workers"}));
}

}  // namespace
}  // namespace split_mapf
