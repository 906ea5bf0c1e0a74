#include "ros/fleet/vda5050_bridge.h"

#include <gtest/gtest.h>

#include <string>

#include "ros/one_parameter.h"
#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

using test::parametersOf;

TEST(Vda5050BridgeOptions, HaveTheirDefaults) {
  const Vda5050BridgeOptions options = readVda5050BridgeOptions(XmlRpc::XmlRpcValue());
  EXPECT_EQ(options.host, "localhost");
  EXPECT_EQ(options.port, 1883);
  EXPECT_EQ(options.interface_name, "uagv");
  EXPECT_EQ(options.version, "v2");
  EXPECT_EQ(options.vehicle.version, "2.0.0");
  EXPECT_TRUE(options.robots.empty());
}

TEST(Vda5050BridgeOptions, AreRead) {
  XmlRpc::XmlRpcValue parameters = parametersOf("port", 1884);
  parameters["manufacturer"] = "ACME";
  parameters["resend_time"] = 0.5;
  parameters["robots"][0] = "r1=AGV:1";
  parameters["robots"][1] = "r2";
  const Vda5050BridgeOptions options = readVda5050BridgeOptions(parameters);
  EXPECT_EQ(options.port, 1884);
  EXPECT_EQ(options.vehicle.manufacturer, "ACME");
  EXPECT_EQ(options.vehicle.resend_sec, 0.5);
  ASSERT_EQ(options.robots.size(), 2U);
  EXPECT_EQ(options.robots.at("AGV:1"), "r1");
  EXPECT_EQ(options.robots.at("r2"), "r2");
}

TEST(Vda5050BridgeOptions, ThatCannotBeAreRefusedByName) {
  XmlRpc::XmlRpcValue twice;
  twice["robots"][0] = "r1=AGV";
  twice["robots"][1] = "r2=AGV";
  XmlRpc::XmlRpcValue too_long;
  too_long["robots"][0] = std::string(300, 'r');
  XmlRpc::XmlRpcValue two_serials;
  two_serials["robots"][0] = "r1=A";
  two_serials["robots"][1] = "r1=B";
  XmlRpc::XmlRpcValue nameless;
  nameless["robots"][0] = "r1=";
  for (const auto& [name, parameters] :
       {std::make_pair("~port", parametersOf("port", 0)),
        std::make_pair("~port", parametersOf("port", 65536)),
        std::make_pair("~manufacturer", parametersOf("manufacturer", "A/B")),
        std::make_pair("~interface_name", parametersOf("interface_name", "+")),
        std::make_pair("~allowed_deviation", parametersOf("allowed_deviation", 0.0)),
        std::make_pair("~rate", parametersOf("rate", -1)), std::make_pair("~robots", twice),
        std::make_pair("~robots", two_serials), std::make_pair("~robots", too_long),
        std::make_pair("~robots", nameless)}) {
    try {
      readVda5050BridgeOptions(parameters);
      ADD_FAILURE() << name;
    } catch (const OptionError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace split_mapf
