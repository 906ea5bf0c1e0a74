#include "pipeline/late_robots.h"

#include <limits>

namespace split_mapf {
namespace {

constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

}  // namespace

LateRobots::LateRobots(const DelayModel& model, std::uint32_t robots, std::size_t vertices)
    : delays_(model, robots), standing_(robots), comer_(vertices, kNobody) {}

void LateRobots::nextStep() {
  delays_.nextStep();
  for (std::uint32_t robot = 0; robot < standing_.robots(); ++robot) {
    standing_.observe(robot, delays_.isDelayed(robot));
  }
}

void LateRobots::hold(const std::vector<Vertex>& before, std::vector<Vertex>& now) {
  held_.clear();
  for (std::uint32_t robot = 0; robot < now.size(); ++robot) {
    if (now[robot] == before[robot]) continue;
    comer_[now[robot]] = robot;
    if (delays_.isDelayed(robot)) held_.push_back(robot);
  }
  const std::vector<Vertex> planned = now;
  while (!held_.empty()) {
    const std::uint32_t robot = held_.back();
    held_.pop_back();
    if (now[robot] == before[robot]) continue;
    now[robot] = before[robot];
    const std::uint32_t behind = comer_[before[robot]];
    if (behind != kNobody) held_.push_back(behind);
  }
  for (const Vertex vertex : planned) comer_[vertex] = kNobody;
}

}  // namespace split_mapf
