// Who may go on: cells that are closed, robots that have to be waited for, promises.

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/standing_times.h"
#include "split_mapf/core/promises.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/fleet/fleet_execution.h"

namespace split_mapf {

std::vector<bool> FleetExecution::closedCells() const {
  const Precedence& order = graph_.precedence();
  std::vector<bool> closed = asked_blocked_;
  for (Vertex v = 0; v < closed.size(); ++v) {
    if (strangers_[v]) closed[v] = true;
  }
  for (const Obstacle& obstacle : obstacles_) closed[obstacle.vertex] = true;
  for (std::uint32_t robot = 0; robot < robots_.size(); ++robot) {
    if (takesPart(robot)) continue;
    for (VisitId v = graph_.at(robot); v <= promised_[robot]; ++v) closed[order[v].vertex] = true;
    if (robots_[robot].place != kNoVertex) closed[robots_[robot].place] = true;
    for (const Vertex v : robots_[robot].near) closed[v] = true;
  }
  return closed;
}

/// A robot that takes no part may be anywhere on its way up to its promise.
std::vector<Edge> FleetExecution::closedEdges() const {
  std::vector<Edge> closed;
  if (!options_.moves) return closed;
  const CloseMoves& moves = *options_.moves;
  const Precedence& order = graph_.precedence();
  for (std::uint32_t robot = 0; robot < robots_.size(); ++robot) {
    if (takesPart(robot)) continue;
    for (VisitId v = graph_.at(robot); v < promised_[robot]; ++v) {
      const MoveId move = moves.moveOf(order[v].vertex, order[v + 1].vertex);
      for (const CloseMoves::Close& close : moves.closeTo(move)) {
        // Of values: what it would be given otherwise refers to places that are no more.
        const auto ends = std::minmax({moves.from(close.move), moves.to(close.move)});
        closed.emplace_back(ends.first, ends.second);
      }
    }
  }
  std::sort(closed.begin(), closed.end());
  closed.erase(std::unique(closed.begin(), closed.end()), closed.end());
  return closed;
}

/// Whom what was planned leads to a closed cell has to be planned anew.
void FleetExecution::closeCells() {
  closed_ = closedCells();
  closed_edges_ = closedEdges();
  for (const Joiner& joiner : joiners_) closed_[joiner.at] = true;
  if (leadsToClosed()) incident_ = true;
}

bool FleetExecution::leadsToClosed() const {
  const Precedence& order = graph_.precedence();
  const auto is_closed = [this](Vertex from, Vertex to) {
    if (closed_[to]) return true;
    if (closed_edges_.empty()) return false;
    const auto ends = std::minmax(from, to);
    return std::binary_search(closed_edges_.begin(), closed_edges_.end(),
                              Edge(ends.first, ends.second));
  };
  for (std::uint32_t robot = 0; robot < robots_.size(); ++robot) {
    if (!takesPart(robot)) continue;
    for (VisitId v = promised_[robot] + 1; v <= order.last(robot); ++v) {
      if (is_closed(order[v - 1].vertex, order[v].vertex)) return true;
    }
  }
  return false;
}

/// Cells that are open again may give a way to robots that had none.
void FleetExecution::openCells() {
  ++openings_;
  const auto lacks_way = [](const Robot& robot) { return robot.fault != GoalFault::kNone; };
  if (std::any_of(robots_.begin(), robots_.end(), lacks_way)) incident_ = true;
  closeCells();
}

void FleetExecution::setBlocked(const std::vector<bool>& blocked) {
  if (asked_blocked_ == blocked) return;
  asked_blocked_ = blocked;
  ++snapshot_version_;
  openCells();
}

void FleetExecution::setStrangers(const std::vector<bool>& taken) {
  if (strangers_ == taken) return;
  strangers_ = taken;
  openCells();
}

void FleetExecution::advance(double now) {
  if (restoring_) {
    const bool all = std::all_of(robots_.begin(), robots_.end(),
                                 [](const Robot& robot) { return robot.was_heard; });
    const bool late = now - observed_ > options_.progress_timeout_sec;
    if (!all && !late) return;
    settleRestored(now);
  }
  watch(now);
  grow(now);
  was_advanced_ = true;
}

void FleetExecution::watch(double now) {
  for (std::uint32_t robot = 0; robot < robots_.size(); ++robot) {
    const Robot& record = robots_[robot];
    const bool silent = now - record.heard > options_.progress_timeout_sec;
    const bool is_needed = options_.rolling || !graph_.isDone(robot);
    if (silent && takesPart(robot) && is_needed) dropOut(robot, Absence::kSilent);
    if (record.status == DriveStatus::kBlocked && takesPart(robot)) watchBlocked(robot, now);
    const bool stands = !isUnderWay(robot) && promised_[robot] == graph_.at(robot);
    if (record.paused && stands && takesPart(robot)) dropOut(robot, Absence::kPaused);
  }
  forgetObstacles(now);
  const bool step_over = now - observed_ >= options_.step_sec;
  if (step_over) observeStands(now);
}

/// Before a move it is planned elsewhere; in the middle of one, or where that did not help, others
/// are planned around it.
void FleetExecution::watchBlocked(std::uint32_t robot, double now) {
  Robot& record = robots_[robot];
  const bool for_long = now - record.status_since > options_.progress_timeout_sec;
  const bool has_tried = record.tried_elsewhere || !options_.plans_anew;
  if (isUnderWay(robot) || (has_tried && for_long)) return dropOut(robot, Absence::kBlocked);
  if (!options_.plans_anew) return;
  if (graph_.isDone(robot) || record.tried_elsewhere) return;
  record.tried_elsewhere = true;
  const Vertex ahead = graph_.precedence()[graph_.at(robot) + 1].vertex;
  obstacles_.push_back({ahead, now + options_.obstacle_time_sec});
  voidPromise(robot);
  incident_ = true;
  closeCells();
}

void FleetExecution::forgetObstacles(double now) {
  const auto over = [&](const Obstacle& obstacle) { return obstacle.until <= now; };
  const auto end = std::remove_if(obstacles_.begin(), obstacles_.end(), over);
  if (end == obstacles_.end()) return;
  obstacles_.erase(end, obstacles_.end());
  openCells();
}

/// Once a step: who could go on, and has done nothing for longer than a move and its turns take.
void FleetExecution::observeStands(double now) {
  observed_ = now;
  const double patience = options_.step_sec + 2 * options_.turn_sec;
  for (std::uint32_t robot = 0; robot < robots_.size(); ++robot) {
    const bool stands = mayMove(robot) && now - robots_[robot].moved > patience;
    standing_->observe(robot, takesPart(robot) && stands);
  }
}

void FleetExecution::grow(double now) {
  std::vector<bool> held_back(robots_.size());
  for (std::uint32_t robot = 0; robot < robots_.size(); ++robot) {
    const Robot& record = robots_[robot];
    held_back[robot] = isHeld(robot) || record.void_promise || !takesPart(robot);
  }
  const Cut before = promised_;
  PromiseRule rule{options_.release_ahead, options_.joint_rings, &closed_, &held_back};
  if (isAwaited()) rule.limit = &question_cut_;
  growPromises(graph_, rule, promised_);
  const Precedence& order = graph_.precedence();
  for (std::uint32_t robot = 0; robot < robots_.size(); ++robot) {
    if (promised_[robot] != before[robot]) {
      changed_[robot] = true;
      // Who was waiting does not count as standing from when it came.
      if (before[robot] == graph_.at(robot)) robots_[robot].moved = now;
    }
    if (held_back[robot] || mayMove(robot) || graph_.isDone(robot)) continue;
    if (closed_[order[graph_.at(robot) + 1].vertex]) incident_ = true;
  }
}

void FleetExecution::remove(std::uint32_t robot) {
  const Precedence& order = graph_.precedence();
  std::vector<Visit> visits;
  std::vector<std::uint32_t> sequences;
  Cut promised;
  for (std::uint32_t i = 0; i < robots_.size(); ++i) {
    if (i == robot) continue;
    const auto number = static_cast<std::uint32_t>(promised.size());
    promised.push_back(static_cast<VisitId>(visits.size()) + promised_[i] - graph_.at(i));
    if (graph_.at(i) > order.first(i)) robots_[i].came_from = order[graph_.at(i) - 1].vertex;
    for (VisitId v = graph_.at(i); v <= order.last(i); ++v) {
      visits.push_back({order[v].vertex, number, order[v].step, kNoVisit, kNoVisit});
      sequences.push_back(sequences_[v]);
    }
  }
  ExecutionGraph rest(Precedence::fromVisits(std::move(visits), order.vertices()), graph_.release(),
                      options_.moves);
  for (std::uint32_t i = 0, number = 0; i < robots_.size(); ++i) {
    if (i != robot) rest.resume(number++, graph_.progress(i));
  }
  graph_ = std::move(rest);
  sequences_ = std::move(sequences);
  promised_ = std::move(promised);
  robots_.erase(robots_.begin() + robot);
  changed_.assign(robots_.size(), true);
  standing_ = std::make_unique<StandingTimes>(robots());
  ++version_;
  ++snapshot_version_;
  ground_.reset();
  openCells();
}

bool FleetExecution::isJoining(const std::string& id) const {
  const auto is_it = [&](const Joiner& joiner) { return joiner.id == id; };
  return std::any_of(joiners_.begin(), joiners_.end(), is_it);
}

bool FleetExecution::removeJoiner(const std::string& id) {
  const auto is_it = [&](const Joiner& joiner) { return joiner.id == id; };
  const auto joiner = std::find_if(joiners_.begin(), joiners_.end(), is_it);
  if (joiner == joiners_.end()) return false;
  const auto index = static_cast<std::size_t>(joiner - joiners_.begin());
  if (asked_ && index < question_joiners_) ++version_;
  // Those behind it may have been asked for with numbers that would be others' now.
  next_number_ += static_cast<std::uint32_t>(joiners_.size());
  joiners_.erase(joiner);
  ++snapshot_version_;
  ground_.reset();
  openCells();
  return true;
}

std::string FleetExecution::add(const std::string& id, Vertex at, Vertex goal) {
  if (restoring_) return "the execution is being taken up again; try later";
  if (find(id) || isJoining(id)) {
    return "robot " + quote(id) + " is one of the fleet already";
  }
  const Precedence& order = graph_.precedence();
  for (std::uint32_t robot = 0; robot < robots_.size(); ++robot) {
    for (VisitId v = graph_.at(robot); v <= promised_[robot]; ++v) {
      if (order[v].vertex != at) continue;
      return "its cell is promised to robot " + quote(robots_[robot].id);
    }
    if (!options_.rolling && robots_[robot].goal == goal) {
      return "its goal is that of robot " + quote(robots_[robot].id);
    }
  }
  for (const Joiner& joiner : joiners_) {
    if (joiner.at == at || (!options_.rolling && joiner.goal == goal)) {
      return "its cell or its goal is that of robot " + quote(joiner.id);
    }
  }
  // While a question is out robots may be promised cells up to its cut.
  for (std::uint32_t robot = 0; isAwaited() && robot < robots_.size(); ++robot) {
    for (VisitId v = promised_[robot]; v <= question_cut_[robot]; ++v) {
      if (order[v].vertex == at) return "its cell may be promised to another robot; try again";
    }
  }
  joiners_.push_back({id, at, options_.rolling ? kNoVertex : goal});
  incident_ = true;
  closeCells();
  return "";
}

}  // namespace split_mapf
