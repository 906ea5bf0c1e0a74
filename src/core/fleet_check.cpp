#include "split_mapf/core/fleet_check.h"

#include <algorithm>
#include <utility>

namespace split_mapf {
namespace {

std::string nameOf(std::size_t robot) { return "robot " + std::to_string(robot); }

}  // namespace

FleetChecker::FleetChecker(std::shared_ptr<const Grid> grid)
    : grid_(std::move(grid)), seen_(grid_->size(), 0), robot_(grid_->size(), 0) {}

std::optional<std::string> FleetChecker::stand(const std::vector<Vertex>& at) {
  ++round_;
  for (std::uint32_t robot = 0; robot < at.size(); ++robot) {
    const Vertex v = at[robot];
    if (v >= grid_->size()) return nameOf(robot) + " is in no free cell";
    if (seen_[v] == round_) {
      return nameOf(robot_[v]) + " and " + nameOf(robot) + " are both at " +
             toString(grid_->cellOf(v));
    }
    seen_[v] = round_;
    robot_[v] = robot;
  }
  return std::nullopt;
}

std::optional<std::string> FleetChecker::step(const std::vector<Vertex>& from,
                                              const std::vector<Vertex>& to) {
  // Who is where behind the step is in robot_.
  for (std::uint32_t robot = 0; robot < to.size(); ++robot) {
    if (from[robot] == to[robot]) continue;
    const Cell a = grid_->cellOf(from[robot]);
    const Cell b = grid_->cellOf(to[robot]);
    if (!grid_->isStep(a, b)) {
      return nameOf(robot) + " jumps from " + toString(a) + " to " + toString(b);
    }
    if (seen_[from[robot]] != round_) continue;
    const std::uint32_t other = robot_[from[robot]];
    if (from[other] == to[robot]) {
      return nameOf(other) + " and " + nameOf(robot) + " swap " + toString(a) + " and " +
             toString(b);
    }
  }
  return std::nullopt;
}

std::optional<std::string> FleetChecker::violation(const std::vector<Vertex>& from,
                                                   const std::vector<Vertex>& to) {
  if (from.size() != to.size()) return "the number of robots changes";
  std::optional<std::string> wrong = stand(from);
  if (!wrong) wrong = stand(to);
  return wrong ? wrong : step(from, to);
}

std::optional<std::string> FleetChecker::violation(const std::vector<Path>& paths) {
  std::size_t last = 0;
  for (std::size_t robot = 0; robot < paths.size(); ++robot) {
    if (paths[robot].empty()) return nameOf(robot) + " has a path without a cell";
    last = std::max(last, paths[robot].size() - 1);
  }
  std::vector<Vertex> before(paths.size());
  std::vector<Vertex> now(paths.size());
  for (std::uint32_t t = 0; t <= last; ++t) {
    for (std::size_t robot = 0; robot < paths.size(); ++robot) {
      now[robot] = positionAt(paths[robot], t);
    }
    std::optional<std::string> wrong = stand(now);
    if (!wrong && t > 0) wrong = step(before, now);
    if (wrong) return "step " + std::to_string(t) + ": " + *wrong;
    before.swap(now);
  }
  return std::nullopt;
}

}  // namespace split_mapf
