#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "split_mapf/core/distance_table.h"
#include "split_mapf/core/grid.h"

namespace split_mapf {

/// A well-posed multi-robot path finding problem: every start and goal is a free cell, no two
/// robots share a start, no two share a goal. A robot may be cut off from its goal: such an
/// instance is well-posed and unsolvable. Immutable and cheap to copy (grid and distance tables
/// are shared); safe to use from several threads, unless its distances are found on demand.
class Instance {
 public:
  /// @throws InstanceError naming every robot and cell at fault; InputError when there is no robot
  /// or the two lists differ in length.
  Instance(std::shared_ptr<const Grid> grid, const std::vector<Cell>& starts,
           const std::vector<Cell>& goals, DistanceExtent extent = DistanceExtent::kAll);
  /// The same from vertices of the grid. @pre every vertex < grid->size().
  static Instance fromVertices(std::shared_ptr<const Grid> grid, const std::vector<Vertex>& starts,
                               const std::vector<Vertex>& goals,
                               DistanceExtent extent = DistanceExtent::kAll);

  /// Robots of `whole` on a part of their ways, from other starts to other goals. Distances are
  /// found on demand, with the help of the whole's; a robot whose goal is the whole's shares its
  /// table, if threads may. @pre one vertex of the whole's grid a robot, and every robot can reach
  /// its goal.
  static Instance stretchOf(const Instance& whole, const std::vector<Vertex>& starts,
                            const std::vector<Vertex>& goals);

  const Grid& grid() const { return *grid_; }
  const std::shared_ptr<const Grid>& sharedGrid() const { return grid_; }
  const Graph& graph() const { return grid_->graph(); }
  std::uint32_t robots() const { return static_cast<std::uint32_t>(starts_.size()); }
  Vertex start(std::uint32_t robot) const { return starts_[robot]; }
  Vertex goal(std::uint32_t robot) const { return goals_[robot]; }
  const std::vector<Vertex>& starts() const { return starts_; }
  const std::vector<Vertex>& goals() const { return goals_; }

  /// Distances to the robot's goal; computed on first use, then shared by all copies.
  const DistanceTable& distances(std::uint32_t robot) const { return (*tables_)[robot]; }
  /// The same, computed until the deadline at most. @throws Interrupted.
  const DistanceTable& distances(std::uint32_t robot, const Deadline& deadline) const {
    return tables_->find(robot, deadline);
  }
  /// The robot's table as a shareable handle.
  std::shared_ptr<const DistanceTable> shareDistances(std::uint32_t robot) const {
    return tables_->share(robot);
  }
  /// Takes a table from an instance whose robot has the same goal. @pre see
  /// DistanceTables::adopt.
  void adoptDistances(std::uint32_t robot, std::shared_ptr<const DistanceTable> table) {
    tables_->adopt(robot, std::move(table));
  }
  /// The robot's shortest path length alone [steps]; DistanceTable::kUnreachable if cut off.
  std::uint32_t shortestLength(std::uint32_t robot) const {
    return distances(robot)(starts_[robot]);
  }

 private:
  std::shared_ptr<const Grid> grid_;
  std::vector<Vertex> starts_;
  std::vector<Vertex> goals_;
  std::shared_ptr<DistanceTables> tables_;
};

/// The first robot that cannot reach its goal even alone, if any.
std::optional<std::uint32_t> findCutOffRobot(const Instance& instance);
/// Greatest shortest path length [steps]. @pre no robot is cut off.
std::uint32_t makespanLowerBound(const Instance& instance);
/// Sum of the shortest path lengths [steps]. @pre no robot is cut off.
std::uint64_t sumOfCostsLowerBound(const Instance& instance);

}  // namespace split_mapf
