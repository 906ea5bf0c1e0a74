// What robots say, and who drops out of the plan or comes back.

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/standing_times.h"
#include "split_mapf/core/close_moves.h"
#include "split_mapf/core/promises.h"
#include "split_mapf/fleet/fleet_execution.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kAnyNumber = 0xffffffffU;

bool isSound(const RobotReport& report) {
  return std::isfinite(report.fraction) && report.fraction >= 0 && report.fraction <= 1 &&
         report.status <= DriveStatus::kFault;
}

bool isReadmitted(Absence absence) {
  return absence != Absence::kNone && absence != Absence::kPaused;
}

}  // namespace

ReportFate FleetExecution::report(std::uint32_t robot, const RobotReport& report, double now) {
  if (!isSound(report)) return ReportFate::kNotANumber;
  Robot& record = robots_[robot];
  record.heard = now;
  record.was_heard = true;
  if (restoring_) {
    record.first_report = report;
    return ReportFate::kTaken;
  }
  ReportFate fate = takeProgress(robot, report, now);
  const ReportFate place = judgePlace(robot, report);
  // Who was seen off its way is back when it is seen on it.
  const bool is_blind = record.strayed_to ? !report.point : !report.place && !report.point;
  const bool stays_astray =
      record.absence == Absence::kAstray && record.was_seen_astray && is_blind;
  if (place == ReportFate::kAstray || stays_astray) fate = ReportFate::kAstray;
  takeStatus(robot, report.status, now);
  const bool drives = report.status == DriveStatus::kOk || report.status == DriveStatus::kPaused;
  if (fate == ReportFate::kTaken && drives && isReadmitted(record.absence)) comeBack(robot);
  return fate;
}

void FleetExecution::hear(std::uint32_t robot, DriveStatus status, const std::optional<Cell>& place,
                          double now, const std::optional<PlanePoint>& point) {
  RobotReport standing;
  standing.sequence = sequences_[graph_.at(robot)];
  standing.status = status;
  standing.place = place;
  standing.point = point;
  report(robot, standing, now);
}

std::optional<VisitId> FleetExecution::visitOf(std::uint32_t robot, std::uint32_t sequence) const {
  const Precedence& order = graph_.precedence();
  const auto begin = sequences_.begin() + order.first(robot);
  const auto end = sequences_.begin() + order.last(robot) + 1;
  const auto found = std::lower_bound(begin, end, sequence);
  if (found == end || *found != sequence) return std::nullopt;
  return static_cast<VisitId>(found - sequences_.begin());
}

ReportFate FleetExecution::takeProgress(std::uint32_t robot, const RobotReport& report,
                                        double now) {
  const VisitId at = graph_.at(robot);
  const std::optional<VisitId> visit = visitOf(robot, report.sequence);
  if (!visit) {
    return report.sequence < sequences_[at] ? ReportFate::kBackwards : ReportFate::kNoSuchVisit;
  }
  const bool moves = report.fraction > 0;
  const VisitId target = *visit + (moves ? 1 : 0);
  if (*visit < at) return ReportFate::kBackwards;
  if (target > promised_[robot]) return ReportFate::kNotReleased;
  const float before = graph_.progress(robot);
  const ReportOutcome outcome = graph_.report(robot, target, moves ? report.fraction : 1);
  if (outcome == ReportOutcome::kBackwards) return ReportFate::kBackwards;
  if (outcome != ReportOutcome::kTaken) return ReportFate::kNotReleased;
  lookForGoal(robot, at);
  if (graph_.at(robot) != at || graph_.progress(robot) != before) {
    robots_[robot].moved = now;
    stalls_ = 0;
  }
  return ReportFate::kTaken;
}

/// Of a rolling fleet: whether it has come to its goal on its way from the visit where it was.
void FleetExecution::lookForGoal(std::uint32_t robot, VisitId before) {
  Robot& record = robots_[robot];
  if (record.goal == kNoVertex || !options_.rolling) return;
  for (VisitId v = before + 1; v <= graph_.at(robot); ++v) {
    if (graph_.precedence()[v].vertex == record.goal) record.reached = true;
  }
}

/// A robot that keeps to its route is in a cell that it is promised. Where moves skip cells it may
/// be in others on the way, which nobody lists.
ReportFate FleetExecution::judgePlace(std::uint32_t robot, const RobotReport& report) {
  if (options_.moves && report.point) return judgePoint(robot, *report.point);
  if (!report.place || !grid_->hasUnitMoves()) return ReportFate::kTaken;
  const Vertex place = grid_->vertexAt(*report.place);
  for (VisitId v = graph_.at(robot); v <= promised_[robot]; ++v) {
    if (graph_.precedence()[v].vertex == place) return ReportFate::kTaken;
  }
  Robot& record = robots_[robot];
  const bool known = record.absence == Absence::kAstray && record.place == place;
  record.place = place;
  record.was_seen_astray = true;
  if (!known) {
    record.absence = Absence::kNone;
    dropOut(robot, Absence::kAstray);
  }
  return ReportFate::kAstray;
}

/// Between the vertices that are promised to it it drives straight.
bool FleetExecution::isOnItsWay(std::uint32_t robot, PlanePoint point) const {
  const Precedence& order = graph_.precedence();
  const auto place = [&](VisitId v) { return options_.moves->place(order[v].vertex); };
  VisitId v = graph_.at(robot);
  do {
    const VisitId next = std::min(v + 1, promised_[robot]);
    if (distanceTo(point, place(v), place(next)) <= options_.distance_m / 2) return true;
    ++v;
  } while (v < promised_[robot]);
  return false;
}

/// While it strays on, what is near to it is looked up again once it has moved by as much as made
/// it stray.
ReportFate FleetExecution::judgePoint(std::uint32_t robot, PlanePoint point) {
  if (options_.distance_m <= 0 || isOnItsWay(robot, point)) return ReportFate::kTaken;
  Robot& record = robots_[robot];
  const bool known = record.absence == Absence::kAstray && record.strayed_to &&
                     std::hypot(record.strayed_to->x - point.x, record.strayed_to->y - point.y) <=
                         options_.distance_m / 2;
  if (known) return ReportFate::kAstray;
  record.strayed_to = point;
  record.was_seen_astray = true;
  // Until it has moved on by half of the distance, too.
  record.near = options_.moves->nearTo(point, point, 1.5 * options_.distance_m);
  record.absence = Absence::kNone;
  dropOut(robot, Absence::kAstray);
  return ReportFate::kAstray;
}

void FleetExecution::takeStatus(std::uint32_t robot, DriveStatus status, double now) {
  Robot& record = robots_[robot];
  if (record.status != status) record.status_since = now;
  record.status = status;
  if (status != DriveStatus::kBlocked) record.tried_elsewhere = false;
  if (status == DriveStatus::kFault) dropOut(robot, Absence::kFault);
  if (status == DriveStatus::kLost) dropOut(robot, Absence::kLost);
  if (status == DriveStatus::kBlocked && takesPart(robot)) watchBlocked(robot, now);
}

/// A robot that strayed keeps its place: what it says of itself later does not change that.
void FleetExecution::dropOut(std::uint32_t robot, Absence absence) {
  Robot& record = robots_[robot];
  if (record.absence == absence || record.absence == Absence::kAstray) return;
  record.absence = absence;
  if (absence == Absence::kFault || absence == Absence::kBlocked) voidPromise(robot);
  incident_ = true;
  closeCells();
}

void FleetExecution::comeBack(std::uint32_t robot) {
  Robot& record = robots_[robot];
  record.absence = record.paused ? Absence::kPaused : Absence::kNone;
  record.place = kNoVertex;
  record.was_seen_astray = false;
  record.strayed_to.reset();
  record.near.clear();
  if (record.void_promise && !options_.plans_anew) renewPromise(robot);
  incident_ = true;
  closeCells();
}

/// It stands, and by its word goes on only to visits with new numbers: what it was promised is free
/// for others, but for where it stands.
void FleetExecution::voidPromise(std::uint32_t robot) {
  promised_[robot] = graph_.at(robot) + (isUnderWay(robot) ? 1 : 0);
  robots_[robot].void_promise = true;
  changed_[robot] = true;
}

/// Where nothing is planned anew it goes on by the same visits, with new numbers.
void FleetExecution::renewPromise(std::uint32_t robot) {
  Robot& record = robots_[robot];
  const VisitId last = graph_.precedence().last(robot);
  for (VisitId v = promised_[robot] + 1; v <= last; ++v) sequences_[v] = record.next_sequence++;
  record.void_promise = false;
  changed_[robot] = true;
  ++snapshot_version_;
}

void FleetExecution::pause(std::uint32_t robot, bool paused) {
  Robot& record = robots_[robot];
  record.paused = paused;
  ++snapshot_version_;
  if (!paused && record.absence == Absence::kPaused) comeBack(robot);
}

void FleetExecution::pauseAll(bool paused) {
  all_paused_ = paused;
  ++snapshot_version_;
  for (std::uint32_t robot = 0; !paused && robot < robots(); ++robot) {
    if (robots_[robot].paused) pause(robot, false);
  }
}

void FleetExecution::cancel() {
  cancelled_ = true;
  ++snapshot_version_;
}

/// Where robots are is taken from their first reports, in any order: what one has done may need
/// what another did before. Of silent ones the others' places tell how far they must have come.
void FleetExecution::settleRestored(double now) {
  const std::uint32_t count = robots();
  std::vector<VisitId> targets(count, 0);
  std::vector<double> parts(count, 1);
  for (std::uint32_t robot = 0; robot < count; ++robot) {
    const RobotReport& report = robots_[robot].first_report;
    const std::optional<VisitId> visit = visitOf(robot, report.sequence);
    if (!robots_[robot].was_heard || !visit) continue;
    const bool moves = report.fraction > 0 && *visit < graph_.precedence().last(robot);
    targets[robot] = *visit + (moves ? 1 : 0);
    if (moves) parts[robot] = report.fraction;
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (std::uint32_t robot = 0; robot < count; ++robot) {
      changed = settleOne(robot, parts[robot], targets) || changed;
    }
  }
  promiseRestored();
  restoring_ = false;
  closeCells();
  for (std::uint32_t robot = 0; robot < count; ++robot) {
    changed_[robot] = true;
    if (!robots_[robot].was_heard) {
      dropOut(robot, Absence::kSilent);
      continue;
    }
    const ReportFate fate = report(robot, robots_[robot].first_report, now);
    if (fate == ReportFate::kNotReleased) {
      robots_[robot].place = graph_.precedence()[targets[robot]].vertex;
      dropOut(robot, Absence::kAstray);
    } else if (fate == ReportFate::kNoSuchVisit) {
      dropOut(robot, Absence::kLost);
    }
  }
}

/// All that robots may have been promised.
void FleetExecution::promiseRestored() {
  PromiseRule rule{std::max(options_.release_ahead, restored_ahead_), options_.joint_rings};
  std::vector<bool> silent;
  Cut limit;
  for (std::uint32_t robot = 0; robot < robots(); ++robot) {
    const Robot& record = robots_[robot];
    silent.push_back(!record.was_heard);
    promised_[robot] = graph_.at(robot) + (isUnderWay(robot) ? 1 : 0);
    limit.push_back(graph_.precedence().last(robot));
    if (record.held_at) limit[robot] = visitOf(robot, *record.held_at).value_or(promised_[robot]);
  }
  rule.held_back = &silent;
  rule.limit = &limit;
  growPromises(graph_, rule, promised_);
  // Who is silent may have gone as far as others let it.
  silent.flip();
  rule.ahead = kAnyNumber;
  growPromises(graph_, rule, promised_);
}

/// Moves a robot to where it is said to be, as far as the others' places allow. @param targets  by
/// robot; of a silent one the least that follows from the others. @return whether anything changed.
bool FleetExecution::settleOne(std::uint32_t robot, double part, std::vector<VisitId>& targets) {
  const Precedence& order = graph_.precedence();
  bool changed = false;
  while (graph_.at(robot) < targets[robot]) {
    const VisitId event = graph_.at(robot) + 1;
    const double fraction = event == targets[robot] ? part : 1;
    if (fraction < 1 && isUnderWay(robot)) break;
    if (graph_.report(robot, event, fraction) != ReportOutcome::kTaken) {
      const std::optional<VisitId> awaited = firstUndone(event);
      const std::uint32_t before = awaited ? order[*awaited].robot : robot;
      if (before == robot || robots_[before].was_heard || targets[before] >= *awaited) break;
      targets[before] = *awaited;
      return true;
    }
    changed = true;
    if (fraction < 1) break;
  }
  return changed;
}

}  // namespace split_mapf
