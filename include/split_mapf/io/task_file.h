#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "split_mapf/core/grid.h"

namespace split_mapf {

/// What robots of a file of tasks have to do: robot i stands at starts[i] and visits goals[i] in
/// their order. Lists may be empty, and cells of different lists the same.
struct GoalLists {
  std::vector<Cell> starts;
  std::vector<std::vector<Cell>> goals;
};

/// Reads lists of goals:
///   robots:
///   - {start: [x, y], goals: [[x, y], [x, y]]}
/// with x = column and y = row from the top; `goals` may be missing. The first `agents` robots, or
/// all. @throws InputError "path:line: ..." for malformed YAML, keys that are unknown or missing,
/// cells that are blocked or outside (naming robot and cell), starts that are there twice, goals
/// that are cut off from the start, and fewer robots than `agents`.
GoalLists readGoalLists(const std::string& path, const Grid& grid,
                        std::optional<std::uint32_t> agents = std::nullopt);

/// Reads the starts of the League of Robot Runners (`.agents`): lines that begin with # are
/// comments, then the number of robots, then a cell a line, as row * width + column.
/// @throws InputError "path:line: ..." as above.
std::vector<Cell> readLeagueAgents(const std::string& path, const Grid& grid,
                                   std::optional<std::uint32_t> agents = std::nullopt);

/// Reads its tasks (`.tasks`): comments, the number of tasks, then a task a line: its cells in
/// order, parted by commas. @throws InputError "path:line: ..." as above.
std::vector<std::vector<Cell>> readLeagueTasks(const std::string& path, const Grid& grid);

}  // namespace split_mapf
