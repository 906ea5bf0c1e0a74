#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/graph.h"

namespace split_mapf {

/// A task that waits for a robot, in a matching.
struct OpenTask {
  Vertex goal = kNoVertex;
  std::uint32_t waited = 0;  ///< [steps]
};

/// Gives tasks robots of their own, as many as possible, at the least sum of ways over cells that
/// are open, where a task is as much nearer as it has waited (up to a bound). Exact: of n rows each
/// need look at no more than its n cheapest columns. Cost: a breadth-first search for each task or
/// robot, whichever are fewer (of n tasks, as far as the n nearest robots), and an assignment of n
/// rows with n candidates each.
/// @param closed  by vertex; a robot that stands there may leave. @return by task: the index of its
/// robot, kNoRobot where there is none.
std::vector<std::uint32_t> matchTasks(const Graph& graph, const std::vector<bool>& closed,
                                      const std::vector<OpenTask>& tasks,
                                      const std::vector<Vertex>& robots);
constexpr std::uint32_t kNoRobot = 0xffffffffU;

/// The connected part of each vertex, among those that are open; 0: it is closed.
std::vector<std::uint32_t> openParts(const Graph& graph, const std::vector<bool>& closed);

}  // namespace split_mapf
