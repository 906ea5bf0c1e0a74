#include "split_mapf/fleet/vda5050_vehicle.h"

#include <gtest/gtest.h>

namespace split_mapf {
namespace {

/// A robot as the standard wants it, on visits 0, 1, 2, ... one metre apart along x. Messages are
/// read as texts: what the class writes is judged in Vda5050.
class VehicleTest : public ::testing::Test {
 protected:
  static Vda5050Options options() {
    Vda5050Options options;
    options.serial_number = "agv";
    return options;
  }
  static PlacedRoute route(const std::string& plan, std::vector<std::uint32_t> sequences,
                           std::size_t released) {
    PlacedRoute route{plan, {}};
    for (std::size_t i = 0; i < sequences.size(); ++i) {
      const auto x = static_cast<double>(sequences[0] + i);
      route.visits.push_back({sequences[i], sequences[i], x, 0, 0, i <= released});
    }
    return route;
  }
  static Vda5050State standing(const std::string& node, const std::string& order = "",
                               std::uint32_t update = 0) {
    Vda5050State state;
    state.order_id = order;
    state.update_id = update;
    state.last_node_id = node;
    return state;
  }
  static Vda5050State withAhead(Vda5050State state, std::vector<Vda5050NodeState> nodes) {
    state.nodes = std::move(nodes);
    return state;
  }
  static Vda5050State withError(Vda5050State state, Vda5050ErrorLevel level) {
    state.errors = {{"trouble", "", level}};
    return state;
  }
  /// "order plan/0 1: plan/1 plan/2 | plan/3", "cancel", or nothing.
  std::string sent(double now) {
    const auto message = vehicle_.due(now, now);
    if (!message) return "";
    if (std::string(message->topic) == "instantActions") {
      return message->text.find("cancelOrder") != std::string::npos ? "cancel" : "?";
    }
    return "order " + summaryOf(message->text);
  }
  /// An order, with where it begins along x: "order plan/1 0: plan/1 plan/2 from 0.5".
  std::string sentWithPlace(double now) {
    const auto message = vehicle_.due(now, now);
    if (!message) return "";
    const std::size_t nodes = message->text.find("\"nodes\":");
    return "order " + summaryOf(message->text) + " from " + valueOf(message->text, "x", nodes);
  }
  static std::string valueOf(const std::string& text, const std::string& key, std::size_t from) {
    std::size_t at = text.find("\"" + key + "\":", from) + key.size() + 3;
    if (text[at] == '"') ++at;
    return text.substr(at, text.find_first_of("\",}", at) - at);
  }
  static std::string summaryOf(const std::string& text) {
    std::string summary =
        valueOf(text, "orderId", 0) + " " + valueOf(text, "orderUpdateId", 0) + ":";
    bool horizon = false;
    const std::size_t nodes = text.find("\"nodes\":");
    for (std::size_t at = nodes; (at = text.find("\"nodeId\":", at)) != std::string::npos; ++at) {
      if (valueOf(text, "released", at) == "false" && !horizon) {
        horizon = true;
        summary += " |";
      }
      summary += " " + valueOf(text, "nodeId", at) + "#" + valueOf(text, "sequenceId", at);
    }
    return summary;
  }
  DriveStatus status(double now) const { return vehicle_.progress(now)->status; }

  Vda5050Vehicle vehicle_{options()};
};

TEST_F(VehicleTest, AnUpdateBeginsWithTheLastNodeOfTheBaseAndWaitsForTheOneBefore) {
  vehicle_.take(route("p", {0, 1, 2, 3, 4}, 2));
  EXPECT_EQ(sent(0), "");  // nobody is there
  vehicle_.take(standing(""), 0);
  EXPECT_EQ(sent(0), "order p/0 0: p/0#0 p/1#2 p/2#4 | p/3#6 p/4#8");
  vehicle_.take(route("p", {1, 2, 3, 4}, 2));
  EXPECT_EQ(sent(1), "");  // it may not have the order yet
  vehicle_.take(standing("p/1", "p/0", 0), 1);
  EXPECT_EQ(sent(1), "order p/0 1: p/2#4 p/3#6 | p/4#8");
  EXPECT_EQ(sent(1.1), "");
  vehicle_.take(standing("p/1", "p/0", 1), 1.2);
  EXPECT_EQ(sent(1.3), "");
  // Others come behind the base: visits that keep their place in the count have new names.
  vehicle_.take(route("p", {2, 3, 17, 18}, 2));
  EXPECT_EQ(sent(2), "order p/0 2: p/3#6 p/17#8 | p/18#10");
}

TEST_F(VehicleTest, WhatIsNotAcknowledgedIsSentAgain) {
  vehicle_.take(standing(""), 0);
  vehicle_.take(route("p", {0, 1}, 1));
  const std::string order = "order p/0 0: p/0#0 p/1#2";
  EXPECT_EQ(sent(0), order);
  EXPECT_EQ(sent(1), "");
  EXPECT_EQ(sent(2), order);
  EXPECT_EQ(sent(2.1), "");
  vehicle_.sendAgain();  // the broker is back
  EXPECT_EQ(sent(2.2), order);
  EXPECT_EQ(vehicle_.trouble(9), "");
  EXPECT_NE(vehicle_.trouble(11).find("does not take the order 'p/0'"), std::string::npos);
}

TEST_F(VehicleTest, ARobotThatMayNotMoveIsSentNothing) {
  vehicle_.take(standing(""), 0);
  vehicle_.take(route("p", {0, 1, 2}, 0));
  EXPECT_EQ(sent(0), "");
  // It stands where its route begins, and may be in need there.
  EXPECT_EQ(vehicle_.progress(0)->plan_id, "p");
  vehicle_.take(withError(standing(""), Vda5050ErrorLevel::kFatal), 1);
  EXPECT_EQ(status(1), DriveStatus::kFault);
  EXPECT_EQ(vehicle_.progress(1)->plan_id, "p");
}

TEST_F(VehicleTest, TellsHowFarItHasComeFromItsPlaceOrItsWay) {
  vehicle_.take(standing(""), 0);
  vehicle_.take(route("p", {0, 1, 2, 3}, 2));
  sent(0);
  Vda5050State state = withAhead(standing("p/1", "p/0"), {{"p/2", 4, true}, {"p/3", 6, false}});
  state.since_last_node_m = 0.4;
  vehicle_.take(state, 1);
  EXPECT_EQ(vehicle_.progress(1)->plan_id, "p");
  EXPECT_EQ(vehicle_.progress(1)->sequence, 1U);
  EXPECT_NEAR(vehicle_.progress(1)->fraction, 0.4, 1e-9);
  state.position = Vda5050Position{1.7, 0.05, 0, "map"};
  vehicle_.take(state, 1.1);
  EXPECT_NEAR(vehicle_.progress(1.1)->fraction, 0.7, 1e-9);
  EXPECT_EQ(vehicle_.progress(1.1)->position->x_m, 1.7);
  state.position->x_m = 1.6;  // nobody goes back
  vehicle_.take(state, 1.2);
  EXPECT_NEAR(vehicle_.progress(1.2)->fraction, 0.7, 1e-9);
  state.position = Vda5050Position{55, 0, 0, "another map"};
  vehicle_.take(state, 1.3);
  EXPECT_FALSE(vehicle_.progress(1.3)->position);
  EXPECT_NE(vehicle_.trouble(1.3), "");
  // Within the tolerance of a node, and where nothing more is released: at rest.
  state.last_node_id = "p/2";
  state.position = Vda5050Position{2.1, 0, 0, "map"};
  vehicle_.take(state, 2);
  EXPECT_EQ(vehicle_.progress(2)->fraction, 0);
  state.position->x_m = 2.3;
  vehicle_.take(state, 2.1);
  EXPECT_EQ(vehicle_.progress(2.1)->fraction, 0);
}

TEST_F(VehicleTest, IsSilentWhenItsConnectionIsOrItsStateIsOld) {
  EXPECT_FALSE(vehicle_.progress(0));
  vehicle_.take(standing(""), 0);
  EXPECT_TRUE(vehicle_.progress(30));
  EXPECT_FALSE(vehicle_.progress(36));
  vehicle_.take(Vda5050Connection::kBroken);
  EXPECT_FALSE(vehicle_.progress(1));
  vehicle_.take(route("p", {0, 1}, 1));
  EXPECT_EQ(sent(1), "");
  vehicle_.take(Vda5050Connection::kOnline);
  EXPECT_TRUE(vehicle_.progress(1));
  EXPECT_EQ(sent(1), "order p/0 0: p/0#0 p/1#2");
}

TEST_F(VehicleTest, CountsAsFaultOnlyWhenItHasDroppedItsOrder) {
  vehicle_.take(standing(""), 0);
  vehicle_.take(route("p", {0, 1, 2, 3}, 2));
  sent(0);
  const Vda5050State driving =
      withAhead(standing("p/0", "p/0"), {{"p/1", 2, true}, {"p/2", 4, true}, {"p/3", 6, false}});
  // Its order may still be on the way: it could take it up.
  vehicle_.take(withError(standing(""), Vda5050ErrorLevel::kFatal), 0.5);
  EXPECT_EQ(status(0.5), DriveStatus::kLost);
  EXPECT_EQ(sent(0.5), "");
  vehicle_.take(withError(driving, Vda5050ErrorLevel::kFatal), 1);
  EXPECT_EQ(status(1), DriveStatus::kLost);
  EXPECT_EQ(sent(1), "cancel");
  EXPECT_EQ(sent(1.5), "");
  EXPECT_EQ(sent(3), "cancel");
  const Vda5050State dropped = withError(standing("p/0", "p/0"), Vda5050ErrorLevel::kFatal);
  vehicle_.take(dropped, 4);
  EXPECT_EQ(status(4), DriveStatus::kFault);
  EXPECT_EQ(sent(4), "");
  // Well again: what was released is void; it goes on to visits with new numbers.
  vehicle_.take(standing("p/0", "p/0"), 9);
  EXPECT_EQ(status(9), DriveStatus::kOk);
  EXPECT_EQ(sent(9), "");
  vehicle_.take(route("p", {0, 4, 5}, 1));
  EXPECT_EQ(sent(9), "order p/1 0: p/0#0 p/4#2 | p/5#4");
}

TEST_F(VehicleTest, CountsAsBlockedWhenItHasDroppedItsOrderAndEndsTheMoveThatItBegan) {
  vehicle_.take(standing(""), 0);
  vehicle_.take(route("p", {0, 1, 2}, 2));
  sent(0);
  Vda5050State state = withAhead(standing("p/0", "p/0"), {{"p/1", 2, true}, {"p/2", 4, true}});
  state.position = Vda5050Position{0.5, 0, 0, "map"};
  vehicle_.take(withError(state, Vda5050ErrorLevel::kCritical), 1);
  EXPECT_EQ(status(1), DriveStatus::kPaused);
  EXPECT_EQ(sent(1), "cancel");
  state.nodes.clear();
  vehicle_.take(withError(state, Vda5050ErrorLevel::kCritical), 2);
  EXPECT_EQ(status(2), DriveStatus::kBlocked);
  EXPECT_NEAR(vehicle_.progress(2)->fraction, 0.5, 1e-9);
  vehicle_.take(state, 3);
  EXPECT_EQ(status(3), DriveStatus::kBlocked);  // told for a while: messages may be lost
  vehicle_.take(state, 4.5);
  EXPECT_EQ(status(4.5), DriveStatus::kOk);
  EXPECT_EQ(sentWithPlace(4.5),
            "order p/1 0: p/0@500#0 p/1#2 | p/2#4 from 0.5");  // where it stands
}

TEST_F(VehicleTest, GivesNothingUpWhenItIsWellBeforeItWasTold) {
  vehicle_.take(standing(""), 0);
  vehicle_.take(route("p", {0, 1}, 1));
  sent(0);
  vehicle_.take(withError(standing(""), Vda5050ErrorLevel::kCritical), 1);
  vehicle_.take(standing(""), 2);
  EXPECT_EQ(status(2), DriveStatus::kOk);
  EXPECT_EQ(sent(2), "order p/0 0: p/0#0 p/1#2");
}

TEST_F(VehicleTest, ALostOrderIsMadeAnew) {
  vehicle_.take(standing(""), 0);
  vehicle_.take(route("p", {0, 1, 2}, 2));
  sent(0);
  vehicle_.take(standing("p/1", "p/0"), 1);
  EXPECT_EQ(sent(1), "");
  Vda5050State manual = standing("p/1", "p/0");
  manual.automatic = false;
  vehicle_.take(manual, 3.5);
  EXPECT_EQ(status(3.5), DriveStatus::kLost);
  EXPECT_EQ(sent(3.5), "");  // it obeys somebody else
  vehicle_.take(standing("p/1", "p/0"), 4);
  EXPECT_EQ(sent(4), "order p/1 0: p/1#0 p/2#2");
}

TEST_F(VehicleTest, AnotherPlanBeginsWhenTheOldOrderIsDropped) {
  vehicle_.take(standing(""), 0);
  vehicle_.take(route("p", {0, 1, 2}, 1));
  sent(0);
  const Vda5050State rest = withAhead(standing("p/1", "p/0"), {{"p/2", 4, false}});
  vehicle_.take(rest, 1);
  vehicle_.take(route("q", {0, 1, 2}, 1));
  EXPECT_EQ(sent(1), "cancel");
  EXPECT_EQ(vehicle_.progress(1)->plan_id, "p");
  vehicle_.take(standing("p/1", "p/0"), 2);
  EXPECT_EQ(sent(2), "order q/0 0: q/0#0 q/1#2 | q/2#4");
  // It names the first node late.
  Vda5050State begun = withAhead(standing("p/1", "q/0"), {{"q/1", 2, true}, {"q/2", 4, false}});
  begun.since_last_node_m = 0.5;
  vehicle_.take(begun, 3);
  EXPECT_EQ(vehicle_.progress(3)->plan_id, "q");
  EXPECT_EQ(vehicle_.progress(3)->sequence, 0U);
  EXPECT_NEAR(vehicle_.progress(3)->fraction, 0.5, 1e-9);
}

TEST_F(VehicleTest, AnotherProcessTakesOver) {
  const Vda5050State state = withAhead(standing("p/1", "p/4", 7),
                                       {{"p/2", 4, true}, {"p/3", 6, false}, {"p/4", 8, false}});
  Vda5050State under_way = state;
  under_way.last_sequence_id = 2;
  vehicle_.take(under_way, 0);
  EXPECT_EQ(vehicle_.progress(0)->sequence, 1U);
  vehicle_.take(route("p", {0, 1, 2, 3, 4}, 3));
  EXPECT_EQ(sent(0), "order p/4 8: p/2#4 p/3#6 | p/4#8");
}

TEST_F(VehicleTest, TakesOverOnlyWhatIsOnTheRoute) {
  vehicle_.take(withAhead(standing("p/1", "p/4", 7), {{"p/2", 4, true}}), 0);
  vehicle_.take(route("p", {0, 1, 17}, 2));
  EXPECT_EQ(sent(0), "cancel");
  vehicle_.take(standing("p/1", "p/4", 7), 1);
  EXPECT_EQ(sent(1), "order p/5 0: p/1#0 p/17#2");
}

TEST_F(VehicleTest, AnUpdateOfAnotherProcessIsNotTakenForItsOwnUnderTheSameNumber) {
  const Vda5050State old =
      withAhead(standing("p/0", "p/0", 0), {{"p/1", 2, true}, {"p/2", 4, false}});
  vehicle_.take(old, 0);
  vehicle_.take(route("p", {0, 1, 2, 3}, 3));
  EXPECT_EQ(sent(0), "order p/0 1: p/1#2 p/2#4 p/3#6");
  // What came first was an update that the process before had sent.
  vehicle_.take(
      withAhead(standing("p/0", "p/0", 1), {{"p/1", 2, true}, {"p/2", 4, true}, {"p/3", 6, false}}),
      1);
  EXPECT_EQ(sent(1), "order p/0 2: p/2#4 p/3#6");
}

TEST_F(VehicleTest, AnOrderThatWasRefusedIsMadeAnewWhereTheRobotStands) {
  vehicle_.take(standing("p/0", "p/0", 0), 0);
  vehicle_.take(route("p", {0, 1, 2}, 2));
  EXPECT_EQ(sent(0), "order p/1 0: p/0#0 p/1#2 p/2#4");
  // The process before had sent an update that came first.
  Vda5050State busy = withAhead(standing("p/0", "p/0", 1), {{"p/1", 2, true}});
  vehicle_.take(busy, 1);
  EXPECT_EQ(sent(1), "cancel");
  busy.nodes.clear();
  busy.since_last_node_m = 0.6;
  vehicle_.take(busy, 2);
  EXPECT_EQ(sentWithPlace(2), "order p/2 0: p/0@600#0 p/1#2 p/2#4 from 0.6");
}

// A robot that knows no place of its own counts its way from there.
TEST_F(VehicleTest, AnOrderThatBeganOnTheWayIsCountedFromThere) {
  vehicle_.take(standing("p/0@500", "p/2", 0), 0);
  vehicle_.take(route("p", {0, 1, 2}, 2));
  EXPECT_NEAR(vehicle_.progress(0)->fraction, 0.5, 1e-9);
  EXPECT_EQ(sent(0), "order p/3 0: p/0@500#0 p/1#2 p/2#4");
  Vda5050State state = withAhead(standing("p/0@500", "p/3", 0), {{"p/1", 2, true}});
  state.since_last_node_m = 0.25;
  vehicle_.take(withError(state, Vda5050ErrorLevel::kCritical), 1);
  EXPECT_EQ(vehicle_.progress(1)->sequence, 0U);
  EXPECT_NEAR(vehicle_.progress(1)->fraction, 0.75, 1e-9);
  EXPECT_EQ(sent(1), "cancel");
  state.nodes.clear();
  vehicle_.take(withError(state, Vda5050ErrorLevel::kCritical), 2);
  vehicle_.take(state, 4.5);
  EXPECT_EQ(sentWithPlace(4.5), "order p/4 0: p/0@750#0 p/1#2 | p/2#4 from 0.75");
}

TEST_F(VehicleTest, NodesOfOthersAreNotTakenForItsOwn) {
  for (const char* node : {"p/0@", "p/0@1000", "p/0@6x", "p@600", "@600", "p/@600", "/"}) {
    vehicle_.take(standing(node), 0);
    EXPECT_EQ(vehicle_.progress(0)->plan_id, "") << node;
  }
  vehicle_.take(standing("a@b/7@25"), 0);
  EXPECT_EQ(vehicle_.progress(0)->plan_id, "a@b");
  EXPECT_EQ(vehicle_.progress(0)->sequence, 7U);
}

TEST_F(VehicleTest, LeavesOrdersOfOthersAlone) {
  vehicle_.take(withAhead(standing("dock", "job 7"), {{"shelf", 2, true}}), 0);
  vehicle_.take(route("p", {0, 1}, 1));
  EXPECT_EQ(sent(0), "");
  EXPECT_NE(vehicle_.trouble(0).find("'job 7'"), std::string::npos);
  EXPECT_EQ(vehicle_.progress(0)->plan_id, "");
}

TEST_F(VehicleTest, MakesTheFirstOrderOfARoute) {
  const Vda5050Order order = firstOrder(route("p", {0, 1, 2, 3}, 1), options());
  EXPECT_EQ(summaryOf(toJson(order)), "p/0 0: p/0#0 p/1#2 | p/2#4 p/3#6");
}

}  // namespace
}  // namespace split_mapf
