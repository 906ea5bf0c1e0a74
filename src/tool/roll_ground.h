#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/io/map_server.h"
#include "split_mapf/pipeline/roll.h"
#include "split_mapf/roadmap/disc_ground.h"
#include "tool/command_line.h"
#include "tool/robot_options.h"

namespace split_mapf::tool {

/// Where robots of `roll` drive: on the cells of a map, or, where they have size, on its planning
/// graph. Files name cells of the map in both cases.
class RollGround {
 public:
  /// Reads --map and what is said of the robots. @throws InputError, OptionError as plan does;
  /// Interrupted when the deadline strikes before a planning graph is done.
  RollGround(const CommandLine& line, const Deadline& deadline);

  const Grid& map() const { return *map_; }
  const std::shared_ptr<const Grid>& grid() const { return discs_ ? discs_->grid() : map_; }
  bool hasSize() const { return discs_ != nullptr; }

  /// The vertices that free cells of the map stand for: on a planning graph the nearest ones, see
  /// DiscGround. @param who  whose they are, for messages. @throws InputError naming a cell that
  /// none is near to.
  std::vector<Vertex> verticesOf(const std::vector<Cell>& cells, const std::string& who) const;
  /// Follows robots that have size in continuous time. @throws std::logic_error where they come too
  /// near to each other or to an obstacle, which would be a bug.
  void requireApart(const RollReport& report) const;

  // Of robots that have size.
  const OccupancyMap& metres() const { return *metres_; }
  const DiscGround& discs() const { return *discs_; }
  /// At the speed that is given [s]; nothing where none is.
  std::optional<double> stepDuration() const;

 private:
  RobotOptions options_;
  std::optional<OccupancyMap> metres_;
  std::shared_ptr<const Grid> map_;
  std::unique_ptr<const DiscGround> discs_;
};

}  // namespace split_mapf::tool
