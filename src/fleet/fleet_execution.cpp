#include "split_mapf/fleet/fleet_execution.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/standing_times.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/promises.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kMoveTicks = 10;
constexpr std::uint32_t kTriesForAPlan = 3;

void requireWithin(double value, const char* name, double least, double most) {
  if (value >= least && value <= most) return;
  throw OptionError(std::string(name) + " " + numeral(value) + " is out of range: " +
                    numeral(least) + " to " + numeral(most) + " is expected");
}

FleetOptions validOptions(FleetOptions options, double step_sec) {
  options.step_sec = step_sec;
  requireValid(options);
  return options;
}

MotionTimes motionOf(const FleetOptions& options) {
  MotionTimes times;
  times.move = kMoveTicks;
  times.turn =
      static_cast<std::uint32_t>(std::lround(kMoveTicks * options.turn_sec / options.step_sec));
  return times;
}

void requireEdge(const Grid& grid, Vertex from, Vertex to, const std::string& id) {
  const auto next = grid.graph().neighbours(from);
  if (std::find(next.begin(), next.end(), to) != next.end()) return;
  throw InputError("the execution that was kept leads robot " + quote(id) + " from cell " +
                   toString(grid.cellOf(from)) + " to " + toString(grid.cellOf(to)) +
                   ", where this map has no way");
}

Precedence orderOf(const FleetSnapshot& snapshot, const Grid& grid) {
  if (snapshot.width != grid.width() || snapshot.height != grid.height()) {
    throw InputError("the execution that was kept is on a grid of " +
                     std::to_string(snapshot.width) + "x" + std::to_string(snapshot.height) +
                     " cells, the map has " + std::to_string(grid.width()) + "x" +
                     std::to_string(grid.height()));
  }
  std::vector<Visit> visits;
  for (std::uint32_t robot = 0; robot < snapshot.robots.size(); ++robot) {
    const FleetSnapshot::Robot& kept = snapshot.robots[robot];
    if (kept.visits.empty()) {
      throw InputError("the execution that was kept has no visits of robot " + quote(kept.id));
    }
    for (const FleetSnapshot::Visit& visit : kept.visits) {
      const Vertex vertex = grid.vertexAt(visit.cell);
      if (vertex == kNoVertex) {
        throw InputError("the execution that was kept leads robot " + quote(kept.id) + " to cell " +
                         toString(visit.cell) + ", which is not free on this map");
      }
      const bool goes_on = !visits.empty() && visits.back().robot == robot;
      if (goes_on) requireEdge(grid, visits.back().vertex, vertex, kept.id);
      visits.push_back({vertex, robot, visit.step, kNoVisit, kNoVisit});
    }
  }
  return Precedence::fromVisits(std::move(visits), grid.size());
}

}  // namespace

std::string toString(ReportFate fate) {
  switch (fate) {
    case ReportFate::kTaken:
      return "taken";
    case ReportFate::kBackwards:
      return "the robot has been further already";
    case ReportFate::kNotReleased:
      return "the visit is not released";
    case ReportFate::kNoSuchVisit:
      return "there is no such visit on its route any more";
    case ReportFate::kNotANumber:
      return "the fraction is not a number from 0 to 1, or the status none";
    case ReportFate::kAstray:
      break;
  }
  return "the robot is where its route does not lead";
}

std::string toString(Absence absence) {
  switch (absence) {
    case Absence::kNone:
      return "takes part";
    case Absence::kSilent:
      return "does not report any more";
    case Absence::kLost:
      return "says that it is lost";
    case Absence::kFault:
      return "says that it has a fault";
    case Absence::kBlocked:
      return "is blocked";
    case Absence::kAstray:
      return "left its way";
    case Absence::kPaused:
      break;
  }
  return "is paused";
}

void requireValid(const FleetOptions& options) {
  requireWithin(options.release, "release", 0, 1);
  requireWithin(options.step_sec, "step_duration", 1e-3, 1e6);
  requireWithin(options.turn_sec, "turn_time", 0, 100 * options.step_sec);
  requireWithin(options.replan_period_sec, "replan_period", 1e-3, 1e6);
  requireWithin(options.progress_timeout_sec, "progress_timeout", 1e-3, 1e6);
  requireWithin(options.obstacle_time_sec, "obstacle_time", 0, 1e9);
  requireWithin(options.release_ahead, "release_ahead", 1, 1000);
  requireWithin(options.distance_m, "distance between robots", 0, 1e6);
  if (!options.moves || !options.joint_rings) return;
  throw OptionError(
      "rings joint is for robots on grids; those on a planning graph keep apart in a rotation only "
      "at the same speed, so it has to be avoid");
}

FleetExecution::FleetExecution(std::shared_ptr<const Grid> grid, std::vector<std::string> ids,
                               const Plan& plan, const FleetOptions& options, double now)
    : grid_(std::move(grid)),
      options_(validOptions(options, options.step_sec)),
      times_(motionOf(options_)),
      graph_(Precedence(plan, grid_->size()), options.release, options.moves),
      asked_blocked_(grid_->size(), false),
      strangers_(grid_->size(), false),
      standing_(std::make_unique<StandingTimes>(static_cast<std::uint32_t>(ids.size()))),
      began_(now),
      observed_(now),
      next_replan_(now) {
  const Precedence& order = graph_.precedence();
  sequences_.resize(order.size());
  for (std::uint32_t i = 0; i < ids.size(); ++i) {
    Robot robot;
    robot.id = std::move(ids[i]);
    robot.goal = order[order.last(i)].vertex;
    if (options_.rolling) robot.goal = kNoVertex;
    robot.number = next_number_++;
    robot.planned_sec = costOf(plan.paths[i]) * options.step_sec;
    robot.heard = robot.moved = now;
    for (VisitId v = order.first(i); v <= order.last(i); ++v) {
      sequences_[v] = robot.next_sequence++;
    }
    robots_.push_back(std::move(robot));
    promised_.push_back(order.first(i));
  }
  rings_ = static_cast<std::uint32_t>(graph_.rings().size());
  changed_.assign(robots_.size(), true);
  closeCells();
}

FleetExecution::FleetExecution(std::shared_ptr<const Grid> grid, const FleetSnapshot& snapshot,
                               const FleetOptions& options, double now)
    : grid_(std::move(grid)),
      options_(validOptions(options, snapshot.step_sec)),
      times_(motionOf(options_)),
      graph_(orderOf(snapshot, *grid_), snapshot.release, options.moves),
      asked_blocked_(grid_->size(), false),
      strangers_(grid_->size(), false),
      standing_(
          std::make_unique<StandingTimes>(static_cast<std::uint32_t>(snapshot.robots.size()))),
      began_(now - snapshot.elapsed_sec),
      observed_(now),
      next_replan_(now),
      restoring_(true),
      restored_ahead_(snapshot.release_ahead),
      all_paused_(snapshot.all_paused),
      cancelled_(snapshot.cancelled) {
  options_.rolling = snapshot.rolling;
  const Precedence& order = graph_.precedence();
  for (std::uint32_t i = 0; i < snapshot.robots.size(); ++i) {
    const FleetSnapshot::Robot& kept = snapshot.robots[i];
    Robot robot;
    robot.id = kept.id;
    robot.goal = grid_->vertexAt(kept.goal);
    if (robot.goal == kNoVertex) robot.goal = order[order.last(i)].vertex;
    if (snapshot.rolling) robot.goal = kNoVertex;
    robot.number = next_number_++;
    robot.planned_sec = kept.planned_sec;
    robot.paused = kept.paused;
    robot.held_at = kept.held_at;
    robot.next_sequence = kept.next_sequence;
    robot.heard = robot.moved = now;
    for (const FleetSnapshot::Visit& visit : kept.visits) sequences_.push_back(visit.sequence);
    robots_.push_back(std::move(robot));
    promised_.push_back(order.first(i));
  }
  for (const Cell cell : snapshot.blocked) {
    const Vertex vertex = grid_->vertexAt(cell);
    if (vertex != kNoVertex) asked_blocked_[vertex] = true;
  }
  changed_.assign(robots_.size(), false);
  closeCells();
}

FleetExecution::~FleetExecution() = default;

std::optional<std::uint32_t> FleetExecution::find(const std::string& id) const {
  for (std::uint32_t robot = 0; robot < robots_.size(); ++robot) {
    if (robots_[robot].id == id) return robot;
  }
  return std::nullopt;
}

std::vector<RouteStep> FleetExecution::route(std::uint32_t robot, std::uint32_t horizon) const {
  const Precedence& order = graph_.precedence();
  std::vector<RouteStep> steps;
  const VisitId last = order.last(robot);
  const VisitId most = promised_[robot] + std::min(horizon, last - promised_[robot]);
  for (VisitId v = graph_.at(robot); v <= most; ++v) {
    RouteStep step;
    step.sequence = sequences_[v];
    step.vertex = order[v].vertex;
    step.released = v <= promised_[robot];
    if (v > graph_.at(robot) && !step.released) {
      graph_.forEachAwaited(v, [&](VisitId awaited, double fraction) {
        if (order[awaited].robot == robot || graph_.hasDone(awaited, fraction)) return;
        step.waits.push_back({order[awaited].robot, sequences_[awaited - 1], fraction});
      });
    }
    steps.push_back(std::move(step));
  }
  return steps;
}

std::vector<std::uint32_t> FleetExecution::takeChanged() {
  std::vector<std::uint32_t> robots;
  if (restoring_) return robots;
  for (std::uint32_t robot = 0; robot < robots_.size(); ++robot) {
    if (changed_[robot]) robots.push_back(robot);
    changed_[robot] = false;
  }
  return robots;
}

std::vector<FleetRobotStatus> FleetExecution::status(double now) const {
  const Precedence& order = graph_.precedence();
  const Forecast ahead = forecast(graph_, times_, {}, {});
  std::vector<FleetRobotStatus> all(robots_.size());
  for (std::uint32_t robot = 0; robot < robots_.size(); ++robot) {
    FleetRobotStatus& status = all[robot];
    const Robot& record = robots_[robot];
    const VisitId at = graph_.at(robot);
    status.sequence = sequences_[at];
    status.released_until = sequences_[promised_[robot]];
    status.absence = record.absence;
    status.fault = record.fault;
    status.idle = options_.rolling && record.goal == kNoVertex;
    status.arrived = record.reached || (graph_.isDone(robot) && vertexOf(robot) == record.goal);
    status.moves = takesPart(robot) && mayMove(robot);
    const double ends =
        graph_.isDone(robot)
            ? record.moved - began_
            : now - began_ + options_.step_sec * ahead.ends[order.last(robot)] / times_.move;
    if (!options_.rolling) status.late_sec = ends - record.planned_sec;
    if (graph_.isDone(robot) || mayMove(robot)) continue;
    const std::optional<VisitId> awaited = firstUndone(at + 1);
    if (awaited) status.waits_for = order[*awaited].robot;
  }
  return all;
}

/// Of what an event waits for.
std::optional<VisitId> FleetExecution::firstUndone(VisitId event) const {
  std::optional<VisitId> first;
  graph_.forEachAwaited(event, [&](VisitId awaited, double fraction) {
    if (!first && !graph_.hasDone(awaited, fraction)) first = awaited;
  });
  return first;
}

bool FleetExecution::isPromised(std::uint32_t robot, Vertex vertex) const {
  for (VisitId v = graph_.at(robot); v <= promised_[robot]; ++v) {
    if (graph_.precedence()[v].vertex == vertex) return true;
  }
  return false;
}

bool FleetExecution::anyMayMove() const {
  for (std::uint32_t robot = 0; robot < robots_.size(); ++robot) {
    if (takesPart(robot) && mayMove(robot)) return true;
  }
  return false;
}

bool FleetExecution::isAnyoneHeld() const {
  if (all_paused_) return true;
  return std::any_of(robots_.begin(), robots_.end(), [](const Robot& robot) {
    return robot.paused && robot.absence == Absence::kPaused;
  });
}

std::vector<Vertex> FleetExecution::ground(std::uint32_t robot) const {
  std::vector<Vertex> vertices;
  for (VisitId v = graph_.at(robot); v <= promised_[robot]; ++v) {
    vertices.push_back(graph_.precedence()[v].vertex);
  }
  return vertices;
}

std::string FleetExecution::trouble() const {
  if (!trouble_.empty() || stalls_ < kTriesForAPlan) return trouble_;
  return "robots would have to rotate, all beginning at once; no other plan was found";
}

bool FleetExecution::isFinished() const {
  if (restoring_ || asked_) return false;
  if (cancelled_) return !anyMayMove();
  if (options_.rolling) return false;
  if (!options_.plans_anew) return was_advanced_ && !anyMayMove() && !isAnyoneHeld();
  if (robots_.empty() && joiners_.empty()) return true;
  if (std::max(failed_, stalls_) >= kTriesForAPlan && !anyMayMove()) return true;
  if (incident_ || !joiners_.empty()) return false;
  for (std::uint32_t robot = 0; robot < robots_.size(); ++robot) {
    if (robots_[robot].absence == Absence::kPaused) return false;
    if (takesPart(robot) && !graph_.isDone(robot)) return false;
  }
  return true;
}

FleetSnapshot FleetExecution::snapshot(double now) const {
  FleetSnapshot kept;
  kept.width = grid_->width();
  kept.height = grid_->height();
  kept.elapsed_sec = now - began_;
  kept.step_sec = options_.step_sec;
  kept.release = graph_.release();
  kept.release_ahead = std::max(options_.release_ahead, restored_ahead_);
  kept.all_paused = all_paused_;
  kept.cancelled = cancelled_;
  kept.rolling = options_.rolling;
  for (Vertex v = 0; v < grid_->size(); ++v) {
    if (asked_blocked_[v]) kept.blocked.push_back(grid_->cellOf(v));
  }
  const Precedence& order = graph_.precedence();
  for (std::uint32_t robot = 0; robot < robots_.size(); ++robot) {
    const Robot& record = robots_[robot];
    FleetSnapshot::Robot part;
    part.id = record.id;
    const bool is_sent = record.goal != kNoVertex;
    part.goal = grid_->cellOf(is_sent ? record.goal : order[order.last(robot)].vertex);
    part.planned_sec = record.planned_sec;
    part.paused = record.paused;
    if (isHeld(robot)) part.held_at = sequences_[promised_[robot]];
    part.next_sequence = record.next_sequence;
    part.visits.reserve(order.last(robot) - graph_.at(robot) + std::size_t{1});
    for (VisitId v = graph_.at(robot); v <= order.last(robot); ++v) {
      part.visits.push_back({sequences_[v], grid_->cellOf(order[v].vertex), order[v].step});
    }
    kept.robots.push_back(std::move(part));
  }
  return kept;
}

}  // namespace split_mapf
