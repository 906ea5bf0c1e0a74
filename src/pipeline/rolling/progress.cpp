#include "pipeline/rolling/progress.h"

#include <algorithm>

namespace split_mapf::rolling {
namespace {

// Steps that a robot may have to go for its first gain once it has rested: one that is pushed about
// does not count as stuck on its way back, nor as gaining all the time.
constexpr std::uint32_t kMostBehind = 16;

}  // namespace

std::uint32_t Progress::note(const MoveGraph& graph, std::uint32_t id, Vertex at, Vertex goal,
                             const Slope& slope, std::uint64_t now) {
  Robot& robot = robots_[id];
  const bool is_new = robot.goal != goal;
  const bool is_measured = !is_new && robot.at != kNoVertex;
  const Slot slot = is_measured ? graph.slotOf(robot.at, at) : MoveGraph::kNoSlot;
  if (slot < kSlots) {  // one move further than last time: its slope says what that was worth
    const std::uint32_t bits = slope[robot.at];
    if ((bits >> slot & 1U) != 0) {
      --robot.left;
    } else if ((bits >> slot & 16U) == 0) {
      ++robot.left;
    }
  } else if (slot != kWait) {
    robot.left = slope.distance(graph, at, 0xffffffffU);
  }
  robot.stands = slot == kWait;
  robot.passed = now - robot.noted;
  robot.noted = now;
  robot.at = at;
  robot.goal = goal;
  if (!is_new && is_measured && robot.left >= robot.best) return robot.left;
  if (!is_new && !is_measured) {
    robot.best = robot.left;
    return robot.left;
  }
  robot.best = robot.left;
  robot.since = now;
  return robot.left;
}

void Progress::measureAnew() {
  for (auto& robot : robots_) robot.second.at = kNoVertex;
}

bool Progress::excuse(std::uint32_t id) {
  Robot& robot = robots_.at(id);
  if (robot.stands) robot.since += robot.passed;
  return robot.stands;
}

void Progress::rest(std::uint32_t id, std::uint64_t now) {
  Robot& robot = robots_.at(id);
  robot.best = std::max(robot.best, robot.left - std::min(robot.left, kMostBehind));
  robot.since = now;
}

std::uint32_t Progress::stuckFor(std::uint32_t id, std::uint64_t now) const {
  const auto robot = robots_.find(id);
  return robot == robots_.end() ? 0 : static_cast<std::uint32_t>(now - robot->second.since);
}

}  // namespace split_mapf::rolling
