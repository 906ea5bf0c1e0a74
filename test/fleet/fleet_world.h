#pragma once

#include <chrono>
#include <cmath>
#include <ctime>
#include <deque>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "split_mapf/core/random.h"
#include "split_mapf/core/route_follower.h"
#include "split_mapf/fleet/fleet_execution.h"
#include "split_mapf/solver/registry.h"
#include "support/disc_checker.h"

namespace split_mapf::test {

inline constexpr double kTickSec = 0.1;

inline PlanePoint pointOf(const Grid& grid, Vertex vertex) {
  const Cell cell = grid.cellOf(vertex);
  return {static_cast<double>(cell.x), static_cast<double>(cell.y)};
}

/// A fleet of discs with everything that goes wrong: late reports and routes, delays, deaths,
/// blocked cells, pauses, and a conductor that dies. Positions are watched in continuous time.
class FleetWorld {
 public:
  virtual ~FleetWorld() = default;
  /// @param distance_m  that centres keep on a planning graph.
  FleetWorld(std::shared_ptr<const Grid> grid, const Plan& plan, const FleetOptions& options,
             std::uint64_t seed, double distance_m = 0)
      : grid_(std::move(grid)),
        options_(options),
        engine_(seed),
        executor_(1),
        planner_(builtinSolvers(), executor_),
        checker_(options.moves ? distance_m / 2 - 2e-6 : options.release / 2) {
    std::vector<std::string> ids;
    for (std::uint32_t i = 0; i < plan.paths.size(); ++i) {
      ids.push_back("r" + std::to_string(i));
      bodies_.emplace_back(placeOf(plan.paths[i].front()), motion(), ids.back());
    }
    fleet_ = std::make_unique<FleetExecution>(grid_, ids, plan, options_, now_);
    kept_ = fleet_->snapshot(now_);
  }

  struct Body {
    Body(PlanePoint at, const RobotMotion& motion, std::string name)
        : robot(at, 0, motion), id(std::move(name)) {}
    RouteFollower robot;
    std::string id;
    DriveStatus status = DriveStatus::kOk;
    bool silent = false;
    bool removed = false;
    int held = 0;  // ticks
    bool fresh = true;
    struct Sent {
      int due;
      RobotReport report;
    };
    struct Route {
      int due;
      std::vector<RouteLeg> legs;
    };
    std::deque<Sent> reports;
    std::deque<Route> routes;
  };

  void tick() {
    ++tick_;
    now_ += kTickSec;
    for (Body& body : bodies_) drive(body);
    std::vector<DiscChecker::Point> centres;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const PlanePoint at = bodies_[i].robot.position();
      // Off the floor, far from all others.
      if (bodies_[i].removed) centres.push_back({-1000.0 - 10.0 * static_cast<double>(i), 0});
      if (!bodies_[i].removed) centres.push_back({at.x, at.y});
    }
    checker_.next(centres);
    deliverReports();
    fleet_->advance(now_);
    handOut();
    conductReplans();
    sendRoutes();
  }

  bool run(int most) {
    for (int i = 0; i < most && !fleet_->isFinished(); ++i) tick();
    return fleet_->isFinished();
  }

  Body& body(const std::string& id) {
    for (Body& body : bodies_) {
      if (body.id == id) return body;
    }
    throw std::logic_error("no body " + id);
  }

  /// The conductor dies, and another one takes over from what it kept last.
  virtual void restart() {
    question_.reset();
    options_.budget.seed += 1000;
    fleet_ = std::make_unique<FleetExecution>(grid_, kept_, options_, now_);
    for (Body& body : bodies_) body.reports.clear();
  }

  void die(const std::string& id, bool silent) {
    Body& victim = body(id);
    victim.status = DriveStatus::kFault;
    victim.silent = silent;
    victim.robot.giveUp();
    victim.held = 1000000;
  }

  std::shared_ptr<const Grid> grid_;
  FleetOptions options_;
  RandomEngine engine_;
  double now_ = 100;
  int tick_ = 0;
  Executor executor_;
  Planner planner_;
  DiscChecker checker_;
  std::vector<Body> bodies_;
  std::unique_ptr<FleetExecution> fleet_;
  FleetSnapshot kept_;
  std::uint64_t kept_version_ = 1;
  int delay_one_in_ = 0;
  std::uint32_t anew_ = 0;

  PlanePoint placeOf(Vertex vertex) const {
    return options_.moves ? options_.moves->place(vertex) : pointOf(*grid_, vertex);
  }

 protected:
  /// What a conductor does beside its execution, once a tick.
  virtual void handOut() {}
  virtual FleetAnswer answerTo(const FleetQuestion& question) {
    return answerFleet(question, planner_, request_, {});
  }

  RobotMotion motion() {
    RobotMotion motion;
    if (drawBelow(engine_, 2) == 0) motion.acceleration = 2;
    if (drawBelow(engine_, 2) == 0) motion.turn_rate = M_PI;
    return motion;
  }

  void drive(Body& body) {
    while (!body.routes.empty() && body.routes.front().due <= tick_) {
      if (body.robot.take(body.routes.front().legs, body.fresh)) body.fresh = false;
      body.routes.pop_front();
    }
    if (body.held == 0 && delay_one_in_ > 0 && drawBelow(engine_, delay_one_in_) == 0) {
      body.held = 5 + static_cast<int>(drawBelow(engine_, 80));
    }
    body.robot.advance(kTickSec, body.held > 0);
    if (body.held > 0) --body.held;
    if (body.silent || body.removed || body.fresh) return;
    RobotReport report{body.robot.sequence(), body.robot.fraction(), body.status, {}};
    const PlanePoint at = body.robot.position();
    report.place = Cell{static_cast<std::int32_t>(std::lround(at.x)),
                        static_cast<std::int32_t>(std::lround(at.y))};
    body.reports.push_back({tick_ + static_cast<int>(drawBelow(engine_, 4)), report});
  }

  /// Mostly where it began, among thousands.
  std::optional<std::uint32_t> find(std::uint32_t body) const {
    const std::string& id = bodies_[body].id;
    if (body < fleet_->robots() && fleet_->id(body) == id) return body;
    return fleet_->find(id);
  }

  void deliverReports() {
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
      Body& body = bodies_[i];
      const auto robot = find(i);
      if (body.fresh && robot && !body.silent)
        fleet_->hear(*robot, body.status, std::nullopt, now_);
      while (!body.reports.empty() && body.reports.front().due <= tick_) {
        if (robot) fates_.push_back(fleet_->report(*robot, body.reports.front().report, now_));
        body.reports.pop_front();
      }
    }
  }

  void conductReplans() {
    if (question_ && question_due_ <= tick_) {
      const std::clock_t began = std::clock();
      const auto began_at = std::chrono::steady_clock::now();
      FleetAnswer answer = answerTo(*question_);
      const auto took = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
      (question_->anew ? anew_sec_ : improved_sec_).push_back(took);
      const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - began_at;
      if (question_->anew) anew_wall_sec_.push_back(wall.count());
      fleet_->take(std::move(answer), now_);
      question_.reset();
    }
    if (question_) return;
    question_ = fleet_->ask(now_);
    if (question_ && question_->anew) ++anew_;
    question_due_ = tick_ + static_cast<int>(drawBelow(engine_, 8));
  }

  void sendRoutes() {
    if (fleet_->snapshotVersion() != kept_version_ && !fleet_->isRestoring()) {
      kept_ = fleet_->snapshot(now_);
      kept_version_ = fleet_->snapshotVersion();
    }
    for (const std::uint32_t robot : fleet_->takeChanged()) {
      std::vector<RouteLeg> legs;
      for (const RouteStep& step : fleet_->route(robot, 5)) {
        legs.push_back({step.sequence, placeOf(step.vertex), step.released});
      }
      body(fleet_->id(robot))
          .routes.push_back({tick_ + static_cast<int>(drawBelow(engine_, 4)), std::move(legs)});
    }
  }

  std::optional<FleetQuestion> question_;
  int question_due_ = 0;

 public:
  PlanRequest request_ = [] {
    PlanRequest request;
    request.split = "none";
    request.objective = Objective::kSumOfCosts;
    return request;
  }();
  std::vector<ReportFate> fates_;
  /// What answers took, of plans made anew and of improvements [s of CPU].
  std::vector<double> anew_sec_;
  std::vector<double> improved_sec_;
  std::vector<double> anew_wall_sec_;
};

}  // namespace split_mapf::test
