#include "split_mapf/core/instance.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

/// Turns cells into vertices; reports cells outside the grid or blocked.
std::vector<Vertex> locate(const Grid& grid, const std::vector<Cell>& cells, const char* role,
                           std::vector<InstanceFault>& faults) {
  std::vector<Vertex> vertices(cells.size(), kNoVertex);
  for (std::uint32_t robot = 0; robot < cells.size(); ++robot) {
    vertices[robot] = grid.vertexAt(cells[robot]);
    if (vertices[robot] != kNoVertex) continue;
    const bool outside = !grid.contains(cells[robot]);
    std::string message = "robot " + std::to_string(robot) + ": its " + role + " " +
                          toString(cells[robot]) +
                          (outside ? " lies outside the map of " + std::to_string(grid.width()) +
                                         "x" + std::to_string(grid.height()) + " cells"
                                   : " is a blocked cell; a free cell is needed");
    faults.push_back(
        {robot, outside ? FaultKind::kOutsideMap : FaultKind::kBlockedCell, std::move(message)});
  }
  return vertices;
}

void reportDuplicates(const Grid& grid, const std::vector<Vertex>& vertices, const char* role,
                      FaultKind kind, std::vector<InstanceFault>& faults) {
  std::unordered_map<Vertex, std::uint32_t> owner;
  for (std::uint32_t robot = 0; robot < vertices.size(); ++robot) {
    const Vertex v = vertices[robot];
    if (v == kNoVertex) continue;
    const auto [first, is_new] = owner.emplace(v, robot);
    if (is_new) continue;
    faults.push_back({robot, kind,
                      "robot " + std::to_string(robot) + ": its " + role + " " +
                          toString(grid.cellOf(v)) + " is also the " + role + " of robot " +
                          std::to_string(first->second) + "; each robot needs its own"});
  }
}

}  // namespace

Instance::Instance(std::shared_ptr<const Grid> grid, const std::vector<Cell>& starts,
                   const std::vector<Cell>& goals, DistanceExtent extent)
    : grid_(std::move(grid)) {
  if (starts.size() != goals.size()) {
    throw InputError(counted(starts.size(), "start") + " but " + counted(goals.size(), "goal") +
                     ": one of each a robot is needed");
  }
  if (starts.empty()) throw InputError("an instance needs at least one robot");
  std::vector<InstanceFault> faults;
  starts_ = locate(*grid_, starts, "start", faults);
  goals_ = locate(*grid_, goals, "goal", faults);
  reportDuplicates(*grid_, starts_, "start", FaultKind::kDuplicateStart, faults);
  reportDuplicates(*grid_, goals_, "goal", FaultKind::kDuplicateGoal, faults);
  if (!faults.empty()) {
    std::stable_sort(
        faults.begin(), faults.end(),
        [](const InstanceFault& a, const InstanceFault& b) { return a.robot < b.robot; });
    throw InstanceError(std::move(faults));
  }
  tables_ = std::make_shared<DistanceTables>(*grid_, goals_, extent);
}

Instance Instance::fromVertices(std::shared_ptr<const Grid> grid, const std::vector<Vertex>& starts,
                                const std::vector<Vertex>& goals, DistanceExtent extent) {
  std::vector<Cell> start_cells;
  std::vector<Cell> goal_cells;
  start_cells.reserve(starts.size());
  goal_cells.reserve(goals.size());
  for (const Vertex v : starts) start_cells.push_back(grid->cellOf(v));
  for (const Vertex v : goals) goal_cells.push_back(grid->cellOf(v));
  return Instance(std::move(grid), start_cells, goal_cells, extent);
}

Instance Instance::stretchOf(const Instance& whole, const std::vector<Vertex>& starts,
                             const std::vector<Vertex>& goals) {
  Instance stretch = fromVertices(whole.sharedGrid(), starts, goals, DistanceExtent::kOnDemand);
  stretch.tables_ = std::make_shared<DistanceTables>(*stretch.grid_, starts, goals, whole.tables_);
  for (std::uint32_t i = 0; i < whole.robots(); ++i) {
    if (goals[i] != whole.goal(i) || !whole.distances(i).isShareable()) continue;
    stretch.adoptDistances(i, whole.shareDistances(i));
  }
  return stretch;
}

std::optional<std::uint32_t> findCutOffRobot(const Instance& instance) {
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    if (instance.shortestLength(robot) == DistanceTable::kUnreachable) return robot;
  }
  return std::nullopt;
}

std::uint32_t makespanLowerBound(const Instance& instance) {
  std::uint32_t longest = 0;
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    longest = std::max(longest, instance.shortestLength(robot));
  }
  return longest;
}

std::uint64_t sumOfCostsLowerBound(const Instance& instance) {
  std::uint64_t sum = 0;
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    sum += instance.shortestLength(robot);
  }
  return sum;
}

}  // namespace split_mapf
