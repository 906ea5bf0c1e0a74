#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "split_mapf/core/grid.h"

namespace split_mapf {

/// What a generated map looks like.
enum class MapKind {
  kRandom,     ///< obstacles spread uniformly, as in the paper
  kWarehouse,  ///< shelf blocks two rows deep between aisles, stations along the left and right
               ///< edge
  kRooms,      ///< walled rooms; every wall between two rooms has a door at a random place
};

/// "random", "warehouse" or "rooms".
std::string toString(MapKind kind);
/// The inverse. @throws OptionError for any other text, quoting it.
MapKind parseMapKind(const std::string& text);

/// What to generate.
struct GeneratorOptions {
  MapKind kind = MapKind::kRandom;
  std::uint32_t width = 32;       ///< [cells], at most 2^15; a warehouse has at least 24, rooms 5
  std::uint32_t height = 32;      ///< [cells], at most 2^15; a warehouse has at least 8, rooms 5
  std::optional<double> density;  ///< share of blocked cells, 0 <= density < 1; random maps only,
                                  ///< 0.1 unless given
  std::uint32_t robots = 50;      ///< at least 1, at most the cells of the largest connected part
  std::uint64_t seed = 0;         ///< all randomness
};

/// A map, and robot i's way from starts[i] to goals[i]. Cells of one list are distinct; a robot's
/// goal may be its own start.
struct GeneratedProblem {
  std::shared_ptr<const Grid> grid;
  std::vector<Cell> starts;
  std::vector<Cell> goals;
};

/// Generates a problem. Starts and goals are drawn uniformly from the largest connected part of the
/// map, so that no robot is cut off from its goal. The number of obstacles on a random map is
/// exactly density * cells, rounded. The same options give the same problem on every platform.
/// @throws OptionError for a wish that cannot be met. Cost: O(cells). Thread-safe.
GeneratedProblem generateProblem(const GeneratorOptions& options);

/// Draws robots on a map that is there, in the same way.
/// @param robots  as in GeneratorOptions. @throws OptionError for too many, or none. Cost:
/// O(cells). Thread-safe.
GeneratedProblem drawRobots(std::shared_ptr<const Grid> grid, std::uint32_t robots,
                            std::uint64_t seed);

}  // namespace split_mapf
