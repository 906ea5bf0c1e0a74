#include "tool/roll_task.h"

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/core/grid_parts.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/io/movingai.h"
#include "split_mapf/io/task_file.h"

namespace split_mapf::tool {
namespace {

std::optional<std::uint32_t> readAgents(const CommandLine& line) {
  if (!line.has("agents")) return std::nullopt;
  return static_cast<std::uint32_t>(
      line.wholeNumber("agents", 1, 1, std::numeric_limits<std::uint32_t>::max()));
}

std::vector<Vertex> readStarts(const CommandLine& line, const RollGround& ground,
                               std::uint64_t seed) {
  const std::optional<std::uint32_t> agents = readAgents(line);
  if (!line.has("starts")) {
    if (!agents) throw OptionError("option --agents, or --starts, is needed: how many robots?");
    return drawStarts(*ground.grid(), *agents, seed);
  }
  const std::string file = line.text("starts");
  if (std::filesystem::path(file).extension() == ".agents") {
    return ground.verticesOf(readLeagueAgents(file, ground.map(), agents), file + ": a start");
  }
  return ground.verticesOf(readMovingAiScenario(file, ground.map(), agents).starts,
                           file + ": a start");
}

/// Robot i gets tasks i, i + n, and so on.
void dealOut(const std::string& file, const RollGround& ground, RollTask& task) {
  const Grid& grid = *ground.grid();
  task.goals.resize(task.starts.size());
  const std::vector<std::vector<Cell>> tasks = readLeagueTasks(file, ground.map());
  const GridParts parts(grid);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const std::size_t robot = i % task.starts.size();
    const Vertex start = task.starts[robot];
    const std::string name = file + ": task " + std::to_string(i);
    for (const Vertex goal : ground.verticesOf(tasks[i], name)) {
      if (parts.partOf(goal) != parts.partOf(start)) {
        throw InputError(name + ": its cell " + toString(grid.cellOf(goal)) + " is cut off from " +
                         toString(grid.cellOf(start)) + ", where robot " + std::to_string(robot) +
                         " starts, whose task it is");
      }
      task.goals[robot].push_back(goal);
    }
  }
}

/// @throws InputError for two robots on one vertex, which a map finer than robots allows.
void requireApart(const std::string& file, const Grid& grid, const std::vector<Vertex>& starts) {
  std::unordered_map<Vertex, std::size_t> robots;
  for (std::size_t robot = 0; robot < starts.size(); ++robot) {
    const auto [other, is_first] = robots.emplace(starts[robot], robot);
    if (is_first) continue;
    throw InputError(file + ": robots " + std::to_string(other->second) + " and " +
                     std::to_string(robot) + " both start nearest to the vertex at " +
                     toString(grid.cellOf(starts[robot])) + " of the planning graph");
  }
}

/// Cells that hang together may be near to vertices that do not. @throws InputError naming the
/// first goal that is cut off from its robot.
void requireReachable(const std::string& file, const Grid& grid, const RollTask& task) {
  const GridParts parts(grid);
  for (std::size_t robot = 0; robot < task.goals.size(); ++robot) {
    const Vertex start = task.starts[robot];
    for (const Vertex goal : task.goals[robot]) {
      if (parts.partOf(goal) == parts.partOf(start)) continue;
      throw InputError(file + ": robot " + std::to_string(robot) + ": on the planning graph " +
                       toString(grid.cellOf(goal)) + ", nearest to a goal, is cut off from " +
                       toString(grid.cellOf(start)) + ", nearest to its start");
    }
  }
}

RollTask readLists(const CommandLine& line, const RollGround& ground, const std::string& file) {
  if (line.has("starts"))
    throw OptionError("option --starts: " + quote(file) + " has starts of its own");
  const GoalLists lists = readGoalLists(file, ground.map(), readAgents(line));
  RollTask task;
  task.starts = ground.verticesOf(lists.starts, file + ": a start");
  for (std::size_t robot = 0; robot < lists.goals.size(); ++robot) {
    task.goals.push_back(
        ground.verticesOf(lists.goals[robot], file + ": robot " + std::to_string(robot)));
  }
  if (ground.hasSize()) requireReachable(file, *ground.grid(), task);
  return task;
}

}  // namespace

RollTask readRollTask(const CommandLine& line, const RollGround& ground, std::uint64_t seed) {
  RollTask task;
  const std::string file = line.text("tasks", "random");
  const std::string extension = std::filesystem::path(file).extension().string();
  if (extension == ".yaml" || extension == ".yml") {
    task = readLists(line, ground, file);
  } else {
    task.random = file == "random";
    if (!task.random && extension != ".tasks") {
      throw OptionError("option --tasks: " + quote(file) +
                        " was given; random, a .yaml or a .tasks is expected");
    }
    task.starts = readStarts(line, ground, seed);
    if (!task.random) dealOut(file, ground, task);
  }
  if (ground.hasSize()) requireApart(line.text("starts", file), *ground.grid(), task.starts);
  return task;
}

}  // namespace split_mapf::tool
