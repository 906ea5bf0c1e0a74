#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "split_mapf/core/grid.h"

namespace split_mapf {

/// What a MovingAI `.scen` file asks for: robot i goes from starts[i] to goals[i]. Both lists have
/// one entry a robot, in the file's order.
struct Scenario {
  std::vector<Cell> starts;
  std::vector<Cell> goals;
};

/// Reads a MovingAI `.map`: `.`, `G`, `S` and `E` (where orders come from, in warehouses) are free,
/// `@`, `O`, `T` and `W` are blocked. As other readers do, it takes `height` and `width` in any
/// order and case, does without `type octile`, and passes over empty lines, blanks at the end of a
/// line, a byte order mark, and CR LF.
/// @throws InputError "path:line: what was read, what was expected" for anything malformed or
/// truncated, and for a second map in the file. Cost: O(cells). Thread-safe.
std::shared_ptr<const Grid> readMovingAiMap(const std::string& path);

/// Reads the first `agents` rows of a MovingAI `.scen`, or all of them. Width and height in each
/// row must be the grid's; the name of the map is not compared, since maps get renamed. The length
/// column is a number or missing and is not used: it counts diagonal moves. Columns are parted by
/// tabs, several of them too, or by blanks; a name may hold blanks. The line `version 1` may be
/// missing, and empty lines are passed over. Two robots that share a start or a goal pass here and
/// are refused by Instance.
/// @throws InputError "path:line: ..." for a malformed row, another grid size, a start or goal that
/// is blocked or outside the grid (naming robot and cell), fewer rows than `agents`, no row at all.
Scenario readMovingAiScenario(const std::string& path, const Grid& grid,
                              std::optional<std::uint32_t> agents = std::nullopt);

/// Size of a map [cells].
struct MapSize {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/// The same for a map that is not at hand, but for its size: whether cells are free is not asked.
Scenario readMovingAiScenario(const std::string& path, MapSize size,
                              std::optional<std::uint32_t> agents = std::nullopt);

/// Writes a grid as a `.map` of `.` and `@`. @throws InputError when the file cannot be written.
void writeMovingAiMap(const std::string& path, const Grid& grid);

/// Writes a `.scen` whose rows name `map_name`. The length column holds the 4-connected shortest
/// length [steps], -1 where there is no way; the bucket is a quarter of it.
/// @throws InputError when a cell is blocked or outside, when the two lists differ in length, or
/// when the file cannot be written. Cost: a search between start and goal a robot.
void writeMovingAiScenario(const std::string& path, const std::string& map_name, const Grid& grid,
                           const Scenario& scenario);

}  // namespace split_mapf
