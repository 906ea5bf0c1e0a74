#pragma once

#include <cmath>
#include <deque>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "split_mapf/core/random.h"
#include "split_mapf/fleet/fleet_execution.h"
#include "split_mapf/fleet/vda5050_vehicle.h"
#include "split_mapf/solver/registry.h"
#include "support/disc_checker.h"

namespace split_mapf::test {

/// A robot without hardware that takes orders as the standard wants it, and refuses all others.
class OrderedRobot {
 public:
  OrderedRobot(double x, double y, bool knows_place) : x_(x), y_(y), knows_place_(knows_place) {}

  void take(const std::string& topic, const std::string& text) {
    const nlohmann::json message = nlohmann::json::parse(text);
    if (topic == "instantActions") {
      state_.nodes.clear();
      places_.clear();
      return;
    }
    const auto& nodes = message.at("nodes");
    const std::string id = message.at("orderId");
    const std::uint32_t update = message.at("orderUpdateId");
    if (id == state_.order_id) {
      if (update > state_.update_id && !extend(nodes)) return;
      state_.update_id = std::max(update, state_.update_id);
      return;
    }
    const auto& place = nodes[0].at("nodePosition");
    const double away =
        std::hypot(place.at("x").get<double>() - x_, place.at("y").get<double>() - y_);
    if (!state_.nodes.empty() || away > 0.3) {
      ++refused_;
      return;
    }
    state_.order_id = id;
    state_.update_id = update;
    state_.last_node_id = nodes[0].at("nodeId");
    state_.last_sequence_id = nodes[0].at("sequenceId");
    since_ = 0;
    append(nodes);
  }

  void drive(double seconds) {
    double left = seconds;
    while (left > 0 && state_.errors.empty() && mayGo()) {
      const auto [x, y] = places_.front();
      const double way = std::hypot(x - x_, y - y_);
      const double part = way <= left ? 1 : left / way;
      x_ += part * (x - x_);
      y_ += part * (y - y_);
      since_ += part * way;
      left -= way;
      if (part < 1) return;
      state_.last_node_id = state_.nodes.front().id;
      state_.last_sequence_id = state_.nodes.front().sequence_id;
      state_.nodes.erase(state_.nodes.begin());
      places_.pop_front();
      since_ = 0;
    }
  }

  Vda5050State state() const {
    Vda5050State state = state_;
    state.driving = state.errors.empty() && mayGo();
    state.since_last_node_m = since_;
    if (knows_place_) state.position = Vda5050Position{x_, y_, 0, "map"};
    return state;
  }
  void haveError(std::optional<Vda5050ErrorLevel> level) {
    state_.errors.clear();
    if (level) state_.errors.push_back({"trouble", "", *level});
  }
  double x() const { return x_; }
  double y() const { return y_; }
  int refused() const { return refused_; }

 private:
  bool mayGo() const { return !state_.nodes.empty() && state_.nodes.front().released; }

  bool extend(const nlohmann::json& nodes) {
    while (!state_.nodes.empty() && !state_.nodes.back().released) {
      state_.nodes.pop_back();
      places_.pop_back();
    }
    const bool none = state_.nodes.empty();
    const std::string end = none ? state_.last_node_id : state_.nodes.back().id;
    const std::uint32_t number = none ? state_.last_sequence_id : state_.nodes.back().sequence_id;
    if (nodes[0].at("nodeId") != end || nodes[0].at("sequenceId") != number) {
      ++refused_;
      return false;
    }
    append(nodes);
    return true;
  }
  void append(const nlohmann::json& nodes) {
    for (std::size_t i = 1; i < nodes.size(); ++i) {
      const auto& place = nodes[i].at("nodePosition");
      state_.nodes.push_back(
          {nodes[i].at("nodeId"), nodes[i].at("sequenceId"), nodes[i].at("released")});
      places_.emplace_back(place.at("x"), place.at("y"));
    }
  }

  double x_;
  double y_;
  bool knows_place_;
  Vda5050State state_;
  std::deque<std::pair<double, double>> places_;
  double since_ = 0;
  int refused_ = 0;
};

/// What goes wrong in a Vda5050World: one in so many ticks, and robots; 0: never.
struct Vda5050Mishaps {
  std::uint32_t loss = 0;     ///< of a message
  std::uint32_t twice = 0;    ///< a message comes twice
  std::uint32_t outage = 0;   ///< of the broker, for up to 3 s
  std::uint32_t error = 0;    ///< of a robot, for up to 6 s
  std::uint32_t hold = 0;     ///< a robot stands for up to 4 s
  std::uint32_t restart = 0;  ///< of the process between fleet and robots
};

/// A fleet whose robots speak VDA 5050, messages that come late, twice or never, and a disc checker
/// in continuous time.
class Vda5050World {
 public:
  Vda5050World(std::shared_ptr<const Grid> grid, const Plan& plan, const FleetOptions& options,
               const Vda5050Mishaps& mishaps, std::uint64_t seed)
      : grid_(std::move(grid)), mishaps_(mishaps), engine_(seed), checker_(options.release / 2) {
    std::vector<std::string> ids;
    for (std::uint32_t i = 0; i < plan.paths.size(); ++i) {
      ids.push_back("r" + std::to_string(i));
      const Cell at = grid_->cellOf(plan.paths[i].front());
      links_.emplace_back(OrderedRobot(at.x, at.y, drawBelow(engine_, 2) == 0), vehicle());
    }
    fleet_ = std::make_unique<FleetExecution>(grid_, ids, plan, options, now_);
  }

  bool run(int most) {
    for (int i = 0; i < most && !fleet_->isFinished(); ++i) tick();
    return fleet_->isFinished();
  }
  int refused() const {
    int refused = 0;
    for (const Link& link : links_) refused += link.robot.refused();
    return refused;
  }

  std::shared_ptr<const Grid> grid_;
  Vda5050Mishaps mishaps_;
  RandomEngine engine_;
  DiscChecker checker_;
  double now_ = 100;
  std::unique_ptr<FleetExecution> fleet_;

 private:
  static constexpr double kTickSec = 0.1;
  struct Late {
    int due;
    std::string topic;
    std::string text;
    Vda5050State state;
  };
  struct Link {
    Link(OrderedRobot body, Vda5050Vehicle with)
        : robot(std::move(body)), vehicle(std::move(with)) {}
    OrderedRobot robot;
    Vda5050Vehicle vehicle;
    std::deque<Late> to;
    std::deque<Late> from;
    int error_until = 0;
    int hold_until = 0;
  };

  static Vda5050Vehicle vehicle() {
    Vda5050Options options;
    options.resend_sec = 0.5;
    return Vda5050Vehicle(options);
  }
  bool happens(std::uint32_t one_in) { return one_in > 0 && drawBelow(engine_, one_in) == 0; }
  int later(std::uint32_t ticks) { return tick_ + static_cast<int>(drawBelow(engine_, ticks)); }

  void tick() {
    ++tick_;
    now_ += kTickSec;
    if (happens(mishaps_.outage)) outage_until_ = later(30);
    std::vector<DiscChecker::Point> centres;
    for (Link& link : links_) {
      moveRobot(link);
      centres.push_back({link.robot.x(), link.robot.y()});
    }
    checker_.next(centres);
    for (std::uint32_t i = 0; i < links_.size(); ++i) {
      if (happens(mishaps_.restart)) {
        links_[i].vehicle = vehicle();
        links_[i].vehicle.take(routeOf(i));
      }
      talk(i);
    }
    fleet_->advance(now_);
    if (const auto question = fleet_->ask(now_)) {
      fleet_->take(answerFleet(*question, planner_, request_, {}), now_);
    }
    for (const std::uint32_t robot : fleet_->takeChanged()) {
      links_[robot].vehicle.take(routeOf(robot));
    }
  }

  void moveRobot(Link& link) {
    while (!link.to.empty() && link.to.front().due <= tick_) {
      link.robot.take(link.to.front().topic, link.to.front().text);
      link.to.pop_front();
    }
    if (happens(mishaps_.error) && link.error_until < tick_) {
      link.error_until = later(60);
      link.robot.haveError(drawBelow(engine_, 2) == 0 ? Vda5050ErrorLevel::kCritical
                                                      : Vda5050ErrorLevel::kFatal);
    } else if (link.error_until <= tick_) {
      link.robot.haveError(std::nullopt);
    }
    if (happens(mishaps_.hold)) link.hold_until = later(40);
    if (link.hold_until <= tick_) link.robot.drive(kTickSec);
    send(link.from, {0, "", "", link.robot.state()});
  }

  /// Late, but in order; lost, or twice.
  void send(std::deque<Late>& way, Late message) {
    if (tick_ < outage_until_ || happens(mishaps_.loss)) return;
    message.due = std::max(later(4), way.empty() ? 0 : way.back().due);
    way.push_back(message);
    if (happens(mishaps_.twice)) way.push_back(message);
  }

  void talk(std::uint32_t index) {
    Link& link = links_[index];
    while (!link.from.empty() && link.from.front().due <= tick_) {
      link.vehicle.take(link.from.front().state, now_);
      link.from.pop_front();
    }
    if (tick_ < outage_until_) return;
    if (const auto message = link.vehicle.due(now_, now_)) {
      send(link.to, {0, message->topic, message->text, {}});
    }
    const auto progress = link.vehicle.progress(now_);
    if (!progress) return;
    RobotReport report{progress->sequence, progress->fraction, progress->status, {}};
    if (progress->position) {
      report.place = Cell{static_cast<std::int32_t>(std::lround(progress->position->x_m)),
                          static_cast<std::int32_t>(std::lround(progress->position->y_m))};
    }
    if (progress->plan_id == "p") fleet_->report(index, report, now_);
    if (progress->plan_id != "p") {
      fleet_->hear(index, report.status, report.place, now_);
    }
  }

  PlacedRoute routeOf(std::uint32_t robot) const {
    PlacedRoute route{"p", {}};
    for (const RouteStep& step : fleet_->route(robot, 5)) {
      const Cell cell = grid_->cellOf(step.vertex);
      route.visits.push_back({step.sequence, step.vertex, static_cast<double>(cell.x),
                              static_cast<double>(cell.y), 0, step.released});
    }
    return route;
  }

  Executor executor_{1};
  Planner planner_{builtinSolvers(), executor_};
  PlanRequest request_ = [] {
    PlanRequest request;
    request.split = "none";
    request.objective = Objective::kSumOfCosts;
    return request;
  }();
  std::vector<Link> links_;
  int tick_ = 0;
  int outage_until_ = 0;
};

}  // namespace split_mapf::test
