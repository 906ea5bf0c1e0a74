#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "split_mapf/generate/generator.h"
#include "split_mapf/pipeline/roll.h"
#include "split_mapf/pipeline/rolling.h"

namespace split_mapf::test {

using GridPtr = std::shared_ptr<const Grid>;

inline RollingRobot robotAt(std::uint32_t id, Vertex at, std::vector<Vertex> goals) {
  RollingRobot robot;
  robot.id = id;
  robot.prefix = {at};
  robot.goals = std::move(goals);
  return robot;
}

inline RollingAnswer answerOf(const GridPtr& grid, const RollingQuestion& question,
                              RollingOptions options, std::uint64_t expansions = 20000) {
  Rolling rolling(grid, options);
  rolling.begin(question);
  rolling.improve(expansions);
  return rolling.answer();
}

inline RollingOptions windowOf(std::uint32_t steps) {
  RollingOptions options;
  options.window = steps;
  return options;
}

/// @param density  of blocked cells; nothing: what the generator takes.
inline GridPtr generatedMap(std::uint32_t width, std::uint32_t height,
                            std::optional<double> density, std::uint64_t seed) {
  GeneratorOptions map;
  map.width = width;
  map.height = height;
  map.density = density;
  map.seed = seed;
  map.robots = 1;
  return generateProblem(map).grid;
}

inline GridPtr generatedHall(std::uint32_t side) {
  const GeneratorOptions usual;
  return generatedMap(side, side, usual.density, usual.seed);
}

/// Robots anywhere, whose next goals are drawn.
inline RollTask randomGoals(const Grid& grid, std::uint32_t robots, std::uint64_t seed) {
  RollTask task;
  task.starts = drawStarts(grid, robots, seed);
  task.random = true;
  return task;
}

/// Looks at every entry of every path, with nothing but the grid's cells.
inline void expectValid(const Grid& grid, const std::vector<Path>& paths, std::uint32_t steps) {
  for (std::uint32_t t = 0; t <= steps; ++t) {
    std::set<Vertex> taken;
    std::set<std::pair<Vertex, Vertex>> moves;
    for (const Path& path : paths) {
      ASSERT_EQ(path.size(), steps + std::size_t{1});
      ASSERT_TRUE(taken.insert(path[t]).second) << "two robots in one cell at step " << t;
      if (t == 0 || path[t] == path[t - 1]) continue;
      ASSERT_TRUE(grid.isStep(grid.cellOf(path[t - 1]), grid.cellOf(path[t])));
      ASSERT_EQ(moves.count({path[t], path[t - 1]}), 0U) << "a swap in step " << t;
      moves.insert({path[t - 1], path[t]});
    }
  }
}

}  // namespace split_mapf::test
