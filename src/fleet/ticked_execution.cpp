#include "fleet/ticked_execution.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace split_mapf {

TickedExecution::TickedExecution(const Grid& grid, ExecutionGraph graph, const MotionTimes& times,
                                 std::vector<std::uint32_t> steps)
    : grid_(grid), graph_(std::move(graph)), times_(times), steps_(std::move(steps)) {
  const std::uint32_t robots = order().robots();
  const double part = graph_.release() > 0 ? graph_.release() : 1;
  release_ticks_ = static_cast<std::uint32_t>(std::ceil(part * times_.move - 1e-6));
  // There fractions differ; but who goes first sets out first.
  if (graph_.closeMoves()) release_ticks_ = 1;
  ticks_.assign(robots, 0);
  turning_.assign(robots, 0);
  facing_.assign(robots, kNoVertex);
  came_from_.assign(robots, kNoVertex);
  arrivals_.assign(robots, 0);
  decisions_.assign(robots, Decision::kOpen);
  goOnWith(std::move(graph_));
}

void TickedExecution::goOnWith(ExecutionGraph graph) {
  graph_ = std::move(graph);
  under_way_.clear();
  for (std::uint32_t robot = 0; robot < order().robots(); ++robot) {
    if (graph_.isDone(robot)) continue;
    under_way_.push_back(robot);
    if (ticks_[robot] == 0) faceNext(robot);
  }
}

/// A robot that has begun to turn to a vertex does not begin again.
void TickedExecution::faceNext(std::uint32_t robot) {
  const Vertex next = order()[graph_.at(robot) + 1].vertex;
  if (facing_[robot] == next) return;
  facing_[robot] = next;
  turning_[robot] = 0;
  if (times_.turn == 0 || came_from_[robot] == kNoVertex) return;
  turning_[robot] = times_.turn * quarterTurns(grid_, came_from_[robot], vertexOf(robot), next);
}

/// Whose move decides, if any, whether this robot may go on, for it would move beside it: in a
/// ring, or in a convoy, where the follower must not get ahead.
std::uint32_t TickedExecution::leaderOf(std::uint32_t robot) const {
  const VisitId event = graph_.at(robot) + 1;
  const VisitId awaited = order().awaits(event);
  if (awaited == kNoVisit) return kNobody;
  const std::uint32_t leader = order()[awaited].robot;
  const bool together = graph_.release() <= 0 || graph_.ringOf(event) != nullptr;
  const bool abreast = graph_.at(leader) + 1 == awaited && ticks_[leader] == ticks_[robot];
  return together && abreast ? leader : kNobody;
}

/// What the robot itself and what others have done so far say.
TickedExecution::Decision TickedExecution::decideAlone(std::uint32_t robot,
                                                       const Delays& delays) const {
  if (delays.isDelayed(robot) || turning_[robot] > 0) return Decision::kStay;
  const VisitId event = graph_.at(robot) + 1;
  if (ticks_[robot] == 0 && !steps_.empty() && steps_[event] > barrier_) return Decision::kStay;
  if (graph_.closeMoves()) return decideByCloseMoves(robot, event);
  const VisitId awaited = order().awaits(event);
  if (awaited == kNoVisit) return Decision::kGo;
  const std::uint32_t leader = order()[awaited].robot;
  if (graph_.at(leader) >= awaited) return Decision::kGo;
  if (leaderOf(robot) != kNobody) return Decision::kOpen;
  if (graph_.release() > 0) {
    const bool goes =
        ticks_[robot] > 0 || (graph_.ringOf(event) == nullptr && graph_.hasLeft(awaited));
    return goes ? Decision::kGo : Decision::kStay;
  }
  const bool ahead = graph_.at(leader) + 1 == awaited && ticks_[leader] > ticks_[robot];
  return ahead ? Decision::kGo : Decision::kStay;
}

/// On a planning graph: robots of a ring still move beside each other.
TickedExecution::Decision TickedExecution::decideByCloseMoves(std::uint32_t robot,
                                                              VisitId event) const {
  if (ticks_[robot] == 0 && !graph_.isReleased(event)) return Decision::kStay;
  if (graph_.ringOf(event) == nullptr) return Decision::kGo;
  return leaderOf(robot) != kNobody ? Decision::kOpen : Decision::kGo;
}

/// Follows the chain of robots that would move beside each other up to one that is decided, or
/// closes a ring.
void TickedExecution::decide(std::uint32_t robot, const Delays& delays) {
  chain_.clear();
  Decision decision = Decision::kOpen;
  for (std::uint32_t i = robot; decision == Decision::kOpen;) {
    if (decisions_[i] != Decision::kOpen) {
      decision = decisions_[i];
      break;
    }
    chain_.push_back(i);
    decision = decideAlone(i, delays);
    if (decision != Decision::kOpen) break;
    i = leaderOf(i);
    if (i == robot) decision = Decision::kGo;
  }
  for (const std::uint32_t i : chain_) decisions_[i] = decision;
  if (decision == Decision::kGo) goers_.insert(goers_.end(), chain_.rbegin(), chain_.rend());
}

void TickedExecution::report(std::uint32_t robot, double fraction) {
  if (graph_.report(robot, graph_.at(robot) + 1, fraction) == ReportOutcome::kTaken) return;
  throw std::logic_error("robot " + std::to_string(robot) + " went on without leave");
}

void TickedExecution::advance(std::uint32_t robot) {
  if (++ticks_[robot] < times_.move) return report(robot, progress(robot));
  came_from_[robot] = vertexOf(robot);
  report(robot, 1);
  ticks_[robot] = 0;
  arrivals_[robot] = now_;
  if (!graph_.isDone(robot)) faceNext(robot);
}

void TickedExecution::tick(const Delays& delays) {
  ++now_;
  for (const std::uint32_t robot : under_way_) decisions_[robot] = Decision::kOpen;
  if (!steps_.empty()) {
    barrier_ = 0xffffffffU;
    for (const std::uint32_t robot : under_way_) {
      barrier_ = std::min(barrier_, steps_[graph_.at(robot) + 1]);
    }
  }
  goers_.clear();
  for (const std::uint32_t robot : under_way_) decide(robot, delays);
  for (const std::uint32_t robot : under_way_) {
    if (turning_[robot] > 0 && !delays.isDelayed(robot)) --turning_[robot];
  }
  for (const std::uint32_t robot : goers_) advance(robot);
  const auto done = [this](std::uint32_t robot) { return graph_.isDone(robot); };
  under_way_.erase(std::remove_if(under_way_.begin(), under_way_.end(), done), under_way_.end());
}

}  // namespace split_mapf
