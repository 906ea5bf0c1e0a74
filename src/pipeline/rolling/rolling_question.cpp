#include "pipeline/rolling/rolling_question.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "split_mapf/core/collision.h"
#include "split_mapf/core/error.h"

namespace split_mapf::rolling {
namespace {

std::string nameOf(const RollingRobot& robot) { return "robot " + std::to_string(robot.id); }

void requireOnGraph(const RollingRobot& robot, Vertex v, const char* what, const Grid& grid) {
  if (v < grid.size()) return;
  throw InputError(nameOf(robot) + ": its " + what + " is vertex " + std::to_string(v) +
                   ", the graph has " + std::to_string(grid.size()));
}

void requirePath(const RollingRobot& robot, const Grid& grid, const MoveGraph& graph,
                 std::uint32_t window) {
  if (robot.prefix.empty()) throw InputError(nameOf(robot) + ": its prefix has no cell");
  if (robot.prefix.size() > window + std::size_t{1}) {
    throw InputError(nameOf(robot) + ": its prefix has " + std::to_string(robot.prefix.size() - 1) +
                     " steps, the window " + std::to_string(window));
  }
  for (const Vertex v : robot.prefix) requireOnGraph(robot, v, "prefix", grid);
  for (const Vertex v : robot.known) requireOnGraph(robot, v, "known path", grid);
  for (const Vertex v : robot.goals) requireOnGraph(robot, v, "goal", grid);
  for (std::size_t t = 1; t < robot.prefix.size(); ++t) {
    if (graph.slotOf(robot.prefix[t - 1], robot.prefix[t]) != MoveGraph::kNoSlot) continue;
    throw InputError(nameOf(robot) + ": its prefix jumps from " +
                     toString(grid.cellOf(robot.prefix[t - 1])) + " to " +
                     toString(grid.cellOf(robot.prefix[t])) + " in step " + std::to_string(t));
  }
}

void requireDifferent(const std::vector<RollingRobot>& robots) {
  std::vector<std::uint32_t> ids;
  ids.reserve(robots.size());
  for (const RollingRobot& robot : robots) ids.push_back(robot.id);
  std::sort(ids.begin(), ids.end());
  const auto twice = std::adjacent_find(ids.begin(), ids.end());
  if (twice == ids.end()) return;
  throw InputError("robot " + std::to_string(*twice) + ": is there twice");
}

}  // namespace

void requireSound(const RollingQuestion& question, const Grid& grid, const MoveGraph& graph,
                  std::uint32_t window) {
  requireDifferent(question.robots);
  std::uint32_t last = 0;  // step of the longest prefix
  for (const RollingRobot& robot : question.robots) {
    requirePath(robot, grid, graph, window);
    last = std::max(last, static_cast<std::uint32_t>(robot.prefix.size()) - 1);
  }
  for (const Vertex v : question.blocked) {
    if (v >= grid.size()) {
      throw InputError("blocked vertex " + std::to_string(v) + ": the graph has " +
                       std::to_string(grid.size()));
    }
  }
  std::vector<const RollingRobot*> here(graph.size(), nullptr);
  std::vector<const RollingRobot*> before(last > 0 ? graph.size() : 0, nullptr);
  for (std::uint32_t t = 0; t <= last; ++t) {
    for (const RollingRobot& robot : question.robots) {
      const Vertex at = positionAt(robot.prefix, t);
      const RollingRobot* other = std::exchange(here[at], &robot);
      if (other != nullptr) {
        throw InputError(nameOf(*other) + " and " + nameOf(robot) + " are both at " +
                         toString(grid.cellOf(at)) + " at step " + std::to_string(t) +
                         " if they stop at the ends of their prefixes");
      }
    }
    for (const RollingRobot& robot : question.robots) {
      if (t == 0) break;
      const Vertex from = positionAt(robot.prefix, t - 1);
      const Vertex to = positionAt(robot.prefix, t);
      const RollingRobot* other = before[to];
      if (from == to || other == nullptr || positionAt(other->prefix, t) != from) continue;
      throw InputError(nameOf(*other) + " and " + nameOf(robot) + " swap " +
                       toString(grid.cellOf(from)) + " and " + toString(grid.cellOf(to)) +
                       " in step " + std::to_string(t));
    }
    if (t == last) break;
    before.swap(here);
    if (t == 0) continue;
    for (const RollingRobot& robot : question.robots) {
      here[positionAt(robot.prefix, t - 1)] = nullptr;
    }
  }
}

}  // namespace split_mapf::rolling
