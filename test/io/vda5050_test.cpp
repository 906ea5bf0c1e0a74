#include "split_mapf/io/vda5050.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

using nlohmann::json;

Vda5050Order orderOfThree() {
  Vda5050Order order;
  order.header = {7, 1764374703.25, "2.0.0", "ACME", "agv 1"};
  order.order_id = "plan/0";
  order.update_id = 3;
  order.first_sequence_id = 4;
  order.map_id = "hall";
  order.allowed_deviation_m = 0.1;
  order.nodes = {{"plan/2", "cell 9", 1.5, 2.5, 7, true},
                 {"plan/3", "", 2.5, 2.5, 0, true},
                 {"plan/9", "", 2.5, 5.5, 1.5, false}};
  return order;
}

json stateWithAll() {
  return json::parse(R"({
    "headerId": 1, "timestamp": "2026-11-29T00:05:03.250Z", "version": "2.0.0",
    "manufacturer": "ACME", "serialNumber": "agv 1",
    "orderId": "plan/0", "orderUpdateId": 3, "lastNodeId": "plan/2", "lastNodeSequenceId": 4,
    "nodeStates": [{"nodeId": "plan/3", "sequenceId": 6, "released": true},
                   {"nodeId": "plan/9", "sequenceId": 8, "released": false}],
    "edgeStates": [], "driving": true, "paused": false, "actionStates": [],
    "distanceSinceLastNode": 0.25, "batteryState": {"batteryCharge": 80, "charging": false},
    "agvPosition": {"positionInitialized": true, "x": 1.75, "y": 2.5, "theta": 0, "mapId": "hall"},
    "operatingMode": "AUTOMATIC",
    "errors": [{"errorType": "lowBattery", "errorLevel": "WARNING"}],
    "safetyState": {"eStop": "NONE", "fieldViolation": false}})");
}

/// What is wrong with a state that has a field changed.
std::string refusal(const std::string& pointer, const json& value) {
  json state = stateWithAll();
  state[json::json_pointer(pointer)] = value;
  try {
    parseVda5050State(state.dump());
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(Vda5050, ReleasedNodesAreTheBaseAndTheOthersTheHorizon) {
  const json order = json::parse(toJson(orderOfThree()));
  EXPECT_EQ(order["orderId"], "plan/0");
  EXPECT_EQ(order["orderUpdateId"], 3);
  EXPECT_EQ(order["headerId"], 7);
  EXPECT_EQ(order["timestamp"], "2025-11-29T00:05:03.250Z");
  ASSERT_EQ(order["nodes"].size(), 3U);
  ASSERT_EQ(order["edges"].size(), 2U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(order["nodes"][i]["sequenceId"], 4 + 2 * i);
    EXPECT_EQ(order["nodes"][i]["released"], i < 2);
  }
  EXPECT_EQ(order["edges"][0]["sequenceId"], 5);
  EXPECT_EQ(order["edges"][0]["startNodeId"], "plan/2");
  EXPECT_EQ(order["edges"][0]["endNodeId"], "plan/3");
  EXPECT_EQ(order["edges"][0]["released"], true);
  EXPECT_EQ(order["edges"][1]["released"], false);
  EXPECT_EQ(order["edges"][1]["length"], 3);
  const json& place = order["nodes"][0]["nodePosition"];
  EXPECT_EQ(place["x"], 1.5);
  EXPECT_EQ(place["mapId"], "hall");
  EXPECT_EQ(place["allowedDeviationXY"], 0.1);
  EXPECT_NEAR(place["theta"].get<double>(), 7 - 2 * M_PI, 1e-12);
}

TEST(Vda5050, ANameThatIsNoTextDoesNoHarm) {
  Vda5050Order order = orderOfThree();
  order.order_id = "\"\xff\n";
  EXPECT_NO_THROW(json::parse(toJson(order)));
  EXPECT_EQ(json::parse(toJson(std::vector<Vda5050Order>{order, order})).size(), 2U);
  EXPECT_EQ(json::parse(toJson(std::vector<Vda5050Order>{})).size(), 0U);
}

TEST(Vda5050, CancelsAnOrderByAnInstantAction) {
  const json message = json::parse(cancelOrderJson(orderOfThree().header, "cancel 1"));
  ASSERT_EQ(message["actions"].size(), 1U);
  EXPECT_EQ(message["actions"][0]["actionType"], "cancelOrder");
  EXPECT_EQ(message["actions"][0]["actionId"], "cancel 1");
  EXPECT_EQ(message["serialNumber"], "agv 1");
}

TEST(Vda5050, ReadsAState) {
  const Vda5050State state = parseVda5050State(stateWithAll().dump());
  EXPECT_EQ(state.order_id, "plan/0");
  EXPECT_EQ(state.update_id, 3U);
  EXPECT_EQ(state.last_node_id, "plan/2");
  EXPECT_EQ(state.last_sequence_id, 4U);
  ASSERT_EQ(state.nodes.size(), 2U);
  EXPECT_EQ(state.nodes[0].id, "plan/3");
  EXPECT_EQ(state.nodes[0].sequence_id, 6U);
  EXPECT_TRUE(state.nodes[0].released);
  EXPECT_FALSE(state.nodes[1].released);
  EXPECT_TRUE(state.driving);
  EXPECT_FALSE(state.paused);
  EXPECT_TRUE(state.automatic);
  EXPECT_EQ(state.since_last_node_m, 0.25);
  ASSERT_TRUE(state.position);
  EXPECT_EQ(state.position->x_m, 1.75);
  EXPECT_EQ(state.position->map_id, "hall");
  ASSERT_EQ(state.errors.size(), 1U);
  EXPECT_EQ(state.errors[0].level, Vda5050ErrorLevel::kWarning);
}

TEST(Vda5050, WhatAStateNeedNotSayMayBeMissing) {
  json state = stateWithAll();
  for (const char* field : {"paused", "distanceSinceLastNode", "agvPosition", "safetyState"}) {
    state.erase(field);
  }
  const Vda5050State read = parseVda5050State(state.dump());
  EXPECT_FALSE(read.paused);
  EXPECT_FALSE(read.since_last_node_m);
  EXPECT_FALSE(read.position);
  state["agvPosition"] = {{"positionInitialized", false}};
  EXPECT_FALSE(parseVda5050State(state.dump()).position);
  state["safetyState"] = {{"eStop", "MANUAL"}};
  EXPECT_TRUE(parseVda5050State(state.dump()).paused);
  state["safetyState"] = {{"fieldViolation", true}};
  EXPECT_TRUE(parseVda5050State(state.dump()).paused);
  state["operatingMode"] = "SERVICE";
  EXPECT_FALSE(parseVda5050State(state.dump()).automatic);
}

TEST(Vda5050, NamesTheFieldThatIsWrongAndWhatIsExpected) {
  EXPECT_EQ(refusal("/driving", 1),
            "the message field 'driving' is '1'; true or false is expected");
  EXPECT_EQ(refusal("/nodeStates/1/released", "no"),
            "the message field 'nodeStates[1].released' is '\"no\"'; true or false is expected");
  EXPECT_EQ(refusal("/orderUpdateId", -1),
            "the message field 'orderUpdateId' is '-1'; a whole number of 0 or more is expected");
  EXPECT_EQ(refusal("/errors/0/errorLevel", "BAD"),
            "the message field 'errors[0].errorLevel' is '\"BAD\"'; WARNING, URGENT, CRITICAL or "
            "FATAL is expected");
  EXPECT_EQ(refusal("/operatingMode", "FAST"),
            "the message field 'operatingMode' is '\"FAST\"'; AUTOMATIC, SEMIAUTOMATIC, MANUAL, "
            "SERVICE or TEACHIN is expected");
  EXPECT_EQ(refusal("/lastNodeId", nullptr), "the message has no field 'lastNodeId'");
  EXPECT_EQ(refusal("/agvPosition/x", nullptr), "the message has no field 'agvPosition.x'");
  EXPECT_EQ(refusal("/nodeStates", json::object()),
            "the message field 'nodeStates' is '{}'; an array is expected");
  for (const char* text : {"", "{", "[]", "3", "\xff", "{\"orderId\": 1e999}"}) {
    EXPECT_THROW(parseVda5050State(text), InputError) << text;
    EXPECT_THROW(parseVda5050Connection(text), InputError) << text;
  }
}

TEST(Vda5050, ReadsAConnection) {
  EXPECT_EQ(parseVda5050Connection(R"({"connectionState": "ONLINE"})"), Vda5050Connection::kOnline);
  EXPECT_EQ(parseVda5050Connection(R"({"connectionState": "OFFLINE"})"),
            Vda5050Connection::kOffline);
  EXPECT_EQ(parseVda5050Connection(R"({"connectionState": "CONNECTIONBROKEN"})"),
            Vda5050Connection::kBroken);
  EXPECT_THROW(parseVda5050Connection(R"({"connectionState": "AWAY"})"), InputError);
}

TEST(Vda5050, AMessageThatIsNestedDeeplyOverflowedTheStack) {
  const std::size_t deep = 200000;
  const std::string text =
      R"({"orderId": )" + std::string(deep, '[') + std::string(deep, ']') + "}";
  try {
    parseVda5050State(text);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "the message is nested too deeply");
  }
}

}  // namespace
}  // namespace split_mapf
