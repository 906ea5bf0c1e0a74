#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "split_mapf/fleet/fleet_report.h"
#include "split_mapf/io/vda5050.h"

namespace split_mapf {

/// A visit of a route, with its place in the frame of the map.
struct PlacedVisit {
  std::uint32_t sequence = 0;
  std::uint32_t cell = 0;  ///< for people to read
  double x_m = 0;
  double y_m = 0;
  double theta_rad = 0;
  bool released = false;
};

/// A robot's route as the fleet sends it: from where it knows the robot to be.
struct PlacedRoute {
  std::string plan_id;
  std::vector<PlacedVisit> visits;
};

/// What the fleet is to be told of a robot. `plan_id` is empty before its first order.
struct VehicleProgress {
  std::string plan_id;
  std::uint32_t sequence = 0;
  double fraction = 0;
  DriveStatus status = DriveStatus::kOk;
  std::optional<Vda5050Position> position;
};

struct Vda5050Options {
  std::string version = "2.0.0";
  std::string manufacturer;
  std::string serial_number;
  std::string map_id = "map";
  double allowed_deviation_m = 0.1;
  double resend_sec = 2;          ///< until what is not acknowledged is sent again
  double state_timeout_sec = 35;  ///< the standard has a state every 30 s at least
};

/// The order that begins a route, with number 0 of its plan. @pre the route has visits.
Vda5050Order firstOrder(const PlacedRoute& route, const Vda5050Options& options);

/// One robot that speaks VDA 5050, as the fleet knows it: turns its routes into orders and updates,
/// and its states into progress. Knows no clock, no ROS and no MQTT: the caller tells the time.
///
/// Released visits are the base, the others the horizon. The next update is made when the robot has
/// acknowledged the one before, and begins with the last node of its base; a message that was lost
/// is sent again. A visit is a node "PLAN/SEQUENCE", an order is "PLAN/NUMBER"; an order that
/// begins on the way to the next visit begins with a node "PLAN/SEQUENCE@THOUSANDTHS" of that way:
/// a robot's state says all that is needed, so another process may take over at any time.
///
/// A robot in need (an error that is FATAL or CRITICAL) is told to drop its order. When it has, it
/// counts as kFault or kBlocked, which free what was released to it; until then that stays its own,
/// and it counts as kLost or kPaused. While somebody drives it by hand it counts as kLost.
/// Not thread-safe. Cost of a call: O(visits of the route).
class Vda5050Vehicle {
 public:
  explicit Vda5050Vehicle(Vda5050Options options) : options_(std::move(options)) {}

  void take(PlacedRoute route);
  void take(Vda5050State state, double now);
  void take(Vda5050Connection connection) { online_ = connection == Vda5050Connection::kOnline; }
  /// What is not acknowledged is due at once: the broker was away.
  void sendAgain() { sent_at_.reset(); }

  struct Message {
    const char* topic;  ///< "order" or "instantActions"
    std::string text;
  };
  /// What is to be sent now; it counts as sent. @param unix_sec  for its timestamp.
  std::optional<Message> due(double now, double unix_sec);

  /// Nothing: the robot is silent, offline or without a state for too long.
  std::optional<VehicleProgress> progress(double now) const;
  /// What is wrong, for people; empty: nothing.
  std::string trouble(double now) const;

 private:
  bool isSilent(double now) const {
    return !state_ || !online_ || now - heard_ > options_.state_timeout_sec;
  }
  bool isIdle() const { return state_->nodes.empty() && !state_->driving; }
  bool isBusyElsewhere() const;
  bool isOurs() const;
  bool isAcknowledged() const;
  bool isAsSent() const;
  bool hasError(Vda5050ErrorLevel level) const;
  bool isInNeed() const;
  DriveStatus driveStatus() const;

  void locate();
  double wayDone(const PlacedVisit& from, const PlacedVisit& to, double before_m) const;
  void judge(double now);
  void watchForLostOrder(double now);
  void giveUp(double now);
  void adopt();
  void forgetOrder();

  std::optional<std::size_t> indexOf(std::uint32_t sequence) const;
  std::size_t releasedEnd(std::size_t from) const;
  std::optional<std::size_t> whereToBegin() const;
  bool makeUpdate();
  bool makeOrder();
  void beginUnderWay(Vda5050Order& order, std::size_t from) const;
  Message sendOrder(double now, double unix_sec);
  std::optional<Message> sendCancel(double now, double unix_sec);

  Vda5050Options options_;
  PlacedRoute route_;
  std::optional<Vda5050State> state_;
  double heard_ = 0;
  bool online_ = true;

  // Where the robot is, by its last state.
  std::string at_plan_;
  std::uint32_t at_ = 0;
  double fraction_ = 0;

  // The order that was sent last. Its last node that is released is kept, as an update begins with
  // it.
  std::optional<Vda5050Order> order_;
  PlacedVisit base_begin_;
  PlacedVisit base_end_;
  std::uint32_t base_end_id_ = 0;
  std::uint32_t next_number_ = 0;  ///< of orders of the route's plan
  std::optional<double> sent_at_;
  double first_sent_at_ = 0;
  std::uint32_t order_headers_ = 0;
  std::uint32_t action_headers_ = 0;

  bool drops_ = false;  ///< the robot is to drop that order
  std::optional<double> cancelled_at_;
  std::optional<double> idle_since_;  ///< though there is base left

  DriveStatus given_up_as_ = DriveStatus::kOk;
  double given_up_at_ = 0;
  std::uint32_t given_up_ = 0;  ///< visits with numbers below are void
  std::uint32_t known_ = 0;     ///< the first number that it was never sent
};

}  // namespace split_mapf
