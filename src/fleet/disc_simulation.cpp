#include "split_mapf/fleet/disc_simulation.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "split_mapf/core/instance.h"
#include "split_mapf/roadmap/execution_moves.h"
#include "split_mapf/roadmap/leg_order.h"

namespace split_mapf {
namespace {

std::vector<DrivenLeg> legsOf(const DiscProblem& problem, const Legs& legs, bool at_goal) {
  std::vector<DrivenLeg> driven;
  for (std::size_t i = 0; i < legs.vertices.size(); ++i) {
    const RobotPoses& robot = problem.task().robots[i];
    const MapPoint vertex = placeOf(problem.roadmap(), legs.vertices[i]);
    driven.push_back({at_goal ? vertex : robot.start, at_goal ? robot.goal : vertex,
                      problem.discs().radius_m[i], legs.waves[i]});
  }
  return driven;
}

Instance instanceOf(const LegOrder& order) {
  std::vector<Vertex> starts;
  std::vector<Vertex> goals;
  for (const Path& path : order.plan.paths) {
    starts.push_back(path.front());
    goals.push_back(path.back());
  }
  return Instance::fromVertices(order.grid, starts, goals);
}

/// One call of simulateDiscs().
class DiscRun {
 public:
  DiscRun(const DiscProblem& problem, const SimulationOptions& options, const Deadline& deadline)
      : problem_(problem), options_(options), deadline_(deadline) {
    report_.courses.resize(problem.task().robots.size());
    for (std::size_t i = 0; i < report_.courses.size(); ++i) {
      report_.courses[i].push_back(problem.task().robots[i].start);
    }
  }

  DiscSimulationReport run(const Plan& plan) {
    const LegOrder departure = orderLegs(legsOf(problem_, problem_.attachment().departure, false),
                                         clearance(), problem_.task().names);
    const LegOrder arrival = orderLegs(legsOf(problem_, problem_.attachment().arrival, true),
                                       clearance(), problem_.task().names);
    const SimulationReport away = drive(departure);
    report_.departure_steps = away.executed_makespan;
    report_.unfinished = away.unfinished;
    if (report_.unfinished.empty()) drive(plan);
    if (report_.unfinished.empty()) {
      const SimulationReport home = drive(arrival);
      report_.arrival_steps = home.executed_makespan;
      report_.unfinished = home.unfinished;
    }
    requireApart();
    return std::move(report_);
  }

 private:
  double clearance() const { return problem_.discs().clearance_m; }

  SimulationReport drive(const LegOrder& order) {
    SimulationOptions options = options_;
    options.policy = ExecutionPolicy::kGraph;
    options.turn_time = 0;
    return simulateMoves(instanceOf(order), order.plan, order.moves, options);
  }

  void drive(const Plan& plan) {
    report_.paths =
        simulateMoves(problem_.instance(), plan, closeMovesOf(problem_.roadmap()), options_);
    report_.unfinished = report_.paths.unfinished;
  }

  /// Parts of the run meet different delays, the same ones by any policy.
  SimulationReport simulateMoves(const Instance& instance, const Plan& plan,
                                 const std::shared_ptr<const CloseMoves>& moves,
                                 SimulationOptions options) {
    options.delays.seed += parts_++;
    options.moves = moves;
    options.on_tick = [&](const std::vector<RobotPlace>& places) { record(*moves, places); };
    SimulationReport report = simulate(instance, plan, options, deadline_);
    report_.ticks_per_step = report.ticks_per_step;
    return report;
  }

  void record(const CloseMoves& moves, const std::vector<RobotPlace>& places) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      const PlanePoint a = moves.place(places[i].from);
      const PlanePoint b = moves.place(places[i].to);
      const double part = places[i].progress;
      report_.courses[i].push_back({a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)});
    }
  }

  void requireApart() const {
    const DiscCheck check =
        checkDiscs(*problem_.task().raster, problem_.discs(), report_.courses, 1);
    if (check.violations.empty()) return;
    throw std::logic_error(
        "the simulation executed what is not safe: " +
        explain(check.violations.front(), problem_.task().names, problem_.task().frame));
  }

  const DiscProblem& problem_;
  const SimulationOptions& options_;
  const Deadline& deadline_;
  std::uint64_t parts_ = 0;
  DiscSimulationReport report_;
};

}  // namespace

DiscSimulationReport simulateDiscs(const DiscProblem& problem, const Plan& plan,
                                   const SimulationOptions& options, const Deadline& deadline) {
  return DiscRun(problem, options, deadline).run(plan);
}

}  // namespace split_mapf
