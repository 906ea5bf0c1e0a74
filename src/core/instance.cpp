#include "split_mapf/core/instance.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

#include "core/demand_sample.h"
#include "core/table_pool.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

// Tables of all that take less together are there before a look at the map would have paid.
constexpr std::size_t kFewBytes = std::size_t{8} << 20U;
// Those that take more together than this are found on demand on whatever map.
constexpr std::size_t kManyBytes = std::size_t{256} << 20U;

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

/// Reports vertices that are none of the grid.
void requireVertices(const Grid& grid, std::vector<Vertex>& vertices, const char* role,
                     std::vector<InstanceFault>& faults) {
  for (std::uint32_t robot = 0; robot < vertices.size(); ++robot) {
    if (vertices[robot] < grid.size()) continue;
    faults.push_back({robot, FaultKind::kOutsideMap,
                      "robot " + std::to_string(robot) + ": its " + role + " is vertex " +
                          std::to_string(vertices[robot]) + ", but the grid has " +
                          counted(grid.size(), "vertex", "vertices")});
    vertices[robot] = kNoVertex;
  }
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

void requireSizes(std::size_t starts, std::size_t goals) {
  if (starts != goals) {
    throw InputError(counted(starts, "start") + " but " + counted(goals, "goal") +
                     ": one of each a robot is needed");
  }
  if (starts == 0) throw InputError("an instance needs at least one robot");
}

/// @throws InstanceError for these faults and for duplicates.
void requireNoFaults(const Problem& problem, std::vector<InstanceFault> faults) {
  reportDuplicates(*problem.grid, problem.starts, "start", FaultKind::kDuplicateStart, faults);
  reportDuplicates(*problem.grid, problem.goals, "goal", FaultKind::kDuplicateGoal, faults);
  if (faults.empty()) return;
  std::stable_sort(
      faults.begin(), faults.end(),
      [](const InstanceFault& a, const InstanceFault& b) { return a.robot < b.robot; });
  throw InstanceError(std::move(faults));
}

/// @param standing  tables that are given; 0: none.
Problem wellPosed(Problem problem, std::size_t standing = 0) {
  if (!problem.grid) throw InputError("a problem needs a grid");
  requireSizes(problem.starts.size(), problem.goals.size());
  std::vector<InstanceFault> faults;
  requireVertices(*problem.grid, problem.starts, "start", faults);
  requireVertices(*problem.grid, problem.goals, "goal", faults);
  requireNoFaults(problem, std::move(faults));
  if (standing != 0 && standing != problem.starts.size()) {
    throw InputError(counted(standing, "distance table") + " for " +
                     counted(problem.starts.size(), "robot") + ": none, or one a robot is needed");
  }
  return problem;
}

/// From cells to vertices.
Problem located(std::shared_ptr<const Grid> grid, const std::vector<Cell>& starts,
                const std::vector<Cell>& goals) {
  requireSizes(starts.size(), goals.size());
  std::vector<InstanceFault> faults;
  Problem problem;
  problem.starts = locate(*grid, starts, "start", faults);
  problem.goals = locate(*grid, goals, "goal", faults);
  problem.grid = std::move(grid);
  requireNoFaults(problem, std::move(faults));
  return problem;
}

}  // namespace

Instance::Instance(std::shared_ptr<const Grid> grid, const std::vector<Cell>& starts,
                   const std::vector<Cell>& goals, DistanceExtent extent)
    : problem_(located(std::move(grid), starts, goals)),
      tables_(std::make_shared<const DistanceTables>(*problem_.grid, problem_.goals, extent)) {}

Instance::Instance(Problem problem, DistanceExtent extent, const DistanceTables::Standing& standing)
    : problem_(wellPosed(std::move(problem), standing.size())),
      tables_(std::make_shared<const DistanceTables>(*problem_.grid, problem_.goals, extent,
                                                     standing)) {}

Instance::Instance(Problem problem, std::shared_ptr<const DistanceTables> tables)
    : problem_(wellPosed(std::move(problem))), tables_(std::move(tables)) {}

Instance Instance::fromVertices(std::shared_ptr<const Grid> grid, const std::vector<Vertex>& starts,
                                const std::vector<Vertex>& goals, DistanceExtent extent) {
  return Instance(Problem{std::move(grid), starts, goals}, extent);
}

Instance Instance::stretchOf(const Instance& whole, const std::vector<Vertex>& starts,
                             const std::vector<Vertex>& goals) {
  if (whole.isBounded()) return partOf(whole, Problem{whole.sharedGrid(), starts, goals});
  DistanceTables::Standing standing(whole.robots());
  for (std::uint32_t i = 0; i < whole.robots(); ++i) {
    if (goals[i] != whole.goal(i) || !whole.hasShareableDistances(i)) continue;
    standing[i] = whole.shareDistances(i);
  }
  return Instance(
      Problem{whole.sharedGrid(), starts, goals},
      std::make_shared<const DistanceTables>(whole.grid(), starts, goals, whole.tables_, standing));
}

Instance Instance::boundedTo(std::size_t bytes) const {
  const std::size_t all = tables_->bytesOfAll();
  const bool fits = all <= std::min(bytes, kManyBytes);
  if (!tables_->areAll() || (fits && (all <= kFewBytes || !paysOnDemand(problem_)))) return *this;
  return Instance(problem_, std::make_shared<const DistanceTables>(
                                grid(), starts(), goals(), std::make_shared<TablePool>(bytes)));
}

Instance Instance::partOf(const Instance& whole, Problem problem) {
  auto tables = std::make_shared<const DistanceTables>(*problem.grid, problem.starts, problem.goals,
                                                       whole.tables_->pool());
  return Instance(std::move(problem), std::move(tables));
}

bool Instance::hasShareableDistances(std::uint32_t robot) const {
  if (isBounded()) return false;
  const HeldDistances distances = this->distances(robot);
  return distances->isShareable();
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
