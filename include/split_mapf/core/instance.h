#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "split_mapf/core/distance_table.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/core/problem.h"

namespace split_mapf {

/// A problem that was found well-posed, and the distance tables of whoever solves it. Well-posed:
/// every start and goal is a free cell, no two robots share a start, no two share a goal. A robot
/// may be cut off from its goal: such an instance is well-posed and unsolvable. Immutable and cheap
/// to copy (grid and distance tables are shared); safe to use from several threads, unless its
/// distances are found on demand. No answer depends on which tables it was given.
class Instance {
 public:
  /// @throws InstanceError naming every robot and cell at fault; InputError when there is no robot
  /// or the two lists differ in length.
  Instance(std::shared_ptr<const Grid> grid, const std::vector<Cell>& starts,
           const std::vector<Cell>& goals, DistanceExtent extent = DistanceExtent::kAll);
  /// @param standing  distance tables that others have found already: empty, or one a robot, to
  /// its goal; null where there is none.
  /// @throws InstanceError as above, also where a vertex is none of the grid; InputError.
  explicit Instance(Problem problem, DistanceExtent extent = DistanceExtent::kAll,
                    const DistanceTables::Standing& standing = {});
  /// The same from the parts of a problem.
  static Instance fromVertices(std::shared_ptr<const Grid> grid, const std::vector<Vertex>& starts,
                               const std::vector<Vertex>& goals,
                               DistanceExtent extent = DistanceExtent::kAll);

  /// Robots of `whole` on a part of their ways, from other starts to other goals. Distances are
  /// found on demand, with the help of the whole's; a robot whose goal is the whole's shares its
  /// table, if threads may. @pre one vertex of the whole's grid a robot, and every robot can reach
  /// its goal.
  static Instance stretchOf(const Instance& whole, const std::vector<Vertex>& starts,
                            const std::vector<Vertex>& goals);

  /// The same, with distance tables that take about `bytes` at most: those that were read longest
  /// ago are given up and made again when they are needed. Where few bytes are needed for all, the
  /// map makes ways on demand dear, or distances are on demand already, it is this instance. Tables
  /// that are being read, a few a thread (one a robot in solvers that look at all at once), count
  /// only when they are not read any more.
  Instance boundedTo(std::size_t bytes) const;
  /// A part of a bounded instance: other starts, goals or robots, or a part of the grid. Its tables
  /// share the room. @pre whole.isBounded().
  static Instance partOf(const Instance& whole, Problem problem);
  bool isBounded() const { return tables_->pool() != nullptr; }

  const Problem& problem() const { return problem_; }
  const Grid& grid() const { return *problem_.grid; }
  const std::shared_ptr<const Grid>& sharedGrid() const { return problem_.grid; }
  const Graph& graph() const { return problem_.grid->graph(); }
  std::uint32_t robots() const { return problem_.robots(); }
  Vertex start(std::uint32_t robot) const { return problem_.starts[robot]; }
  Vertex goal(std::uint32_t robot) const { return problem_.goals[robot]; }
  const std::vector<Vertex>& starts() const { return problem_.starts; }
  const std::vector<Vertex>& goals() const { return problem_.goals; }

  /// Distances to the robot's goal; computed on first use, then shared by all copies. Of a bounded
  /// instance they belong to the holder. @pre the instance, or a copy, outlives what it returns.
  HeldDistances distances(std::uint32_t robot) const { return (*tables_)[robot]; }
  /// The same, computed until the deadline at most. @throws Interrupted.
  HeldDistances distances(std::uint32_t robot, const Deadline& deadline) const {
    return tables_->hold(robot, deadline);
  }
  /// Frees the robot's table, if the instance is bounded: nobody is likely to need it soon.
  void giveUpDistances(std::uint32_t robot) const { tables_->giveUp(robot); }
  /// The robot's table as a handle. @pre the instance is not bounded.
  std::shared_ptr<const DistanceTable> shareDistances(std::uint32_t robot) const {
    return tables_->share(robot);
  }
  /// Whether threads may share it.
  bool hasShareableDistances(std::uint32_t robot) const;
  /// The robot's shortest path length alone [steps]; DistanceTable::kUnreachable if cut off. Kept,
  /// whatever becomes of its table.
  std::uint32_t shortestLength(std::uint32_t robot) const {
    return tables_->lengthFrom(start(robot), robot);
  }

 private:
  Instance(Problem problem, std::shared_ptr<const DistanceTables> tables);

  Problem problem_;
  std::shared_ptr<const DistanceTables> tables_;
};

/// The first robot that cannot reach its goal even alone, if any.
std::optional<std::uint32_t> findCutOffRobot(const Instance& instance);
/// Greatest shortest path length [steps]. @pre no robot is cut off.
std::uint32_t makespanLowerBound(const Instance& instance);
/// Sum of the shortest path lengths [steps]. @pre no robot is cut off.
std::uint64_t sumOfCostsLowerBound(const Instance& instance);

}  // namespace split_mapf
