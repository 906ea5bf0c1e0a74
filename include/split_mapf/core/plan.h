#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/graph.h"
#include "split_mapf/core/objective.h"

namespace split_mapf {

/// The vertices of one robot, one a time step, from its start. After its last entry the robot
/// stays where it is. Never empty.
using Path = std::vector<Vertex>;

/// One path a robot, in the instance's order.
struct Plan {
  std::vector<Path> paths;
};

/// Where the robot is at step t; after its last entry it stays.
inline Vertex positionAt(const Path& path, std::uint32_t t) {
  return t < path.size() ? path[t] : path.back();
}
/// The time step [steps] after which the path never leaves its last vertex again; 0 if it never
/// moves.
std::uint32_t costOf(const Path& path);
/// The greatest cost of a path [steps].
std::uint32_t makespanOf(const Plan& plan);
/// The sum of all costs [steps].
std::uint64_t sumOfCostsOf(const Plan& plan);
/// The plan's cost under an objective [steps].
std::uint64_t costOf(const Plan& plan, Objective objective);
/// Cuts every path behind its arrival, so that path.size() - 1 is its cost.
void trimToArrival(Plan& plan);

}  // namespace split_mapf
