#include "support/small_instances.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "split_mapf/core/random.h"
#include "split_mapf/generate/generator.h"
#include "support/ascii_grid.h"

namespace split_mapf::test {
namespace {

std::uint32_t drawBetween(RandomEngine& engine, std::uint32_t least, std::uint32_t most) {
  return least + static_cast<std::uint32_t>(drawBelow(engine, most - least + 1));
}

/// Many robots rather than few, but four only on maps that keep the oracle fast.
std::uint32_t drawRobots(RandomEngine& engine, std::uint32_t free_cells) {
  const std::uint32_t most = free_cells <= 12 ? 4 : 3;
  return std::max(drawBetween(engine, 1, most), drawBetween(engine, 1, most));
}

std::shared_ptr<const Grid> drawGrid(RandomEngine& engine, std::uint32_t width,
                                     std::uint32_t height) {
  std::vector<std::uint32_t> order(std::size_t{width} * height);
  std::iota(order.begin(), order.end(), 0U);
  shuffle(order, engine);
  order.resize(drawBetween(engine, 0, width * height / 3));
  std::vector<bool> free(std::size_t{width} * height, true);
  for (const std::uint32_t blocked : order) free[blocked] = false;
  return std::make_shared<const Grid>(width, height, free);
}

Instance drawInstance(RandomEngine& engine, std::shared_ptr<const Grid> grid,
                      std::uint32_t robots) {
  std::vector<Vertex> cells(grid->size());
  std::iota(cells.begin(), cells.end(), 0U);
  shuffle(cells, engine);
  const std::vector<Vertex> starts(cells.begin(), cells.begin() + robots);
  shuffle(cells, engine);
  const std::vector<Vertex> goals(cells.begin(), cells.begin() + robots);
  return Instance::fromVertices(std::move(grid), starts, goals);
}

}  // namespace

Instance smallInstance(std::uint64_t seed) {
  RandomEngine engine(seed);
  const std::uint32_t width = drawBetween(engine, 3, 5);
  const std::uint32_t height = drawBetween(engine, 3, 5);
  auto grid = drawGrid(engine, width, height);
  const std::uint32_t robots = drawRobots(engine, grid->size());
  return drawInstance(engine, std::move(grid), robots);
}

Instance crowdedInstance(std::uint64_t seed) {
  RandomEngine engine(seed);
  const std::uint32_t width = drawBetween(engine, 2, 4);
  const std::uint32_t height = drawBetween(engine, 2, 4);
  auto grid = drawGrid(engine, width, height);
  const std::uint32_t most = grid->size() <= 6 ? 5 : grid->size() <= 9 ? 4 : 3;
  const std::uint32_t robots = std::min(grid->size() - 1, drawBetween(engine, 2, most));
  return drawInstance(engine, std::move(grid), robots);
}

Instance fiveRobotKnot() {
  return instanceFromAscii({"####", ".b..", "ce#.", "d#a."}, {"####", "..bd", "ac#.", ".#.e"});
}

std::string describe(const Instance& instance) {
  const Grid& grid = instance.grid();
  std::string text = "\n";
  for (std::uint32_t y = 0; y < grid.height(); ++y) {
    for (std::uint32_t x = 0; x < grid.width(); ++x) {
      text += grid.isFree({static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)}) ? '.' : '#';
    }
    text += '\n';
  }
  for (std::uint32_t i = 0; i < instance.robots(); ++i) {
    text += "robot " + std::to_string(i) + ": " + toString(grid.cellOf(instance.start(i))) +
            " -> " + toString(grid.cellOf(instance.goal(i))) + "\n";
  }
  return text;
}

Instance generatedInstance(const GeneratorOptions& options) {
  const GeneratedProblem problem = generateProblem(options);
  return Instance(problem.grid, problem.starts, problem.goals);
}

Instance generatedInstance(std::uint32_t side, double density, std::uint32_t robots,
                           std::uint64_t seed) {
  GeneratorOptions options;
  options.width = options.height = side;
  options.density = density;
  options.robots = robots;
  options.seed = seed;
  return generatedInstance(options);
}

}  // namespace split_mapf::test
