#include "search/occupancy_by_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "split_mapf/core/validate.h"
#include "support/ascii_grid.h"
#include "support/random_plan.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

/// As the paths themselves say it.
void expectAsPlanned(const Grid& grid, const OccupancyBySteps& table, const Plan& plan) {
  const std::uint32_t last = makespanOf(plan);
  const auto path_at = [&](Vertex v, std::uint32_t t) -> const Path* {
    for (const Path& path : plan.paths) {
      if (positionAt(path, t) == v) return &path;
    }
    return nullptr;
  };
  const HeadingGraph graph(grid);
  for (std::uint32_t t = 0; t <= last; ++t) {
    const OccupancyBySteps::Step step = table.at(t);
    for (Vertex v = 0; v < grid.size(); ++v) {
      const Path* const path = path_at(v, t);
      ASSERT_EQ(step.isTaken(v), path != nullptr) << "vertex " << v << ", step " << t;
      const Vertex before = path == nullptr || t == 0 ? v : positionAt(*path, t - 1);
      for (Heading heading = 0; heading < 4; ++heading) {
        const bool entered = before != v && graph.headingOf(before, v) == heading;
        ASSERT_EQ(step.isEntered(v, heading), entered) << "vertex " << v << ", step " << t;
      }
      if (path != nullptr) continue;
      const bool was = t > 0 && path_at(v, t - 1) != nullptr;
      const bool will = t < last && path_at(v, t + 1) != nullptr;
      ASSERT_EQ(step.countBeside(v), (was ? 1U : 0U) + (will ? 1U : 0U))
          << "vertex " << v << ", step " << t;
    }
  }
}

TEST(OccupancyBySteps, SaysWhatThePathsSay) {
  std::size_t exchanged = 0;
  std::size_t refused = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    const auto grid = test::gridFromAscii({".....", ".#...", "...#.", ".....", "..#.."});
    Plan plan = test::randomValidPlan(*grid, 7, 15, engine);
    const Instance instance = test::instanceOf(grid, plan);
    const HeadingGraph graph(*grid);
    OccupancyBySteps table(graph, grid->size(), plan);
    expectAsPlanned(*grid, table, plan);
    for (std::uint32_t draw = 0; draw < 60; ++draw) {
      // A step of the path is replaced, or exchanged with the one beside it.
      const auto robot = static_cast<std::uint32_t>(drawBelow(engine, 7));
      Path other = plan.paths[robot];
      if (other.size() < 3) continue;
      const std::size_t t = 1 + drawBelow(engine, other.size() - 2);
      const std::vector<Vertex> ways = {other[t - 1], other[t + 1],
                                        *grid->graph().neighbours(other[t - 1]).begin()};
      other[t] = ways[drawBelow(engine, 3)];
      const auto is_move = [&](Vertex a, Vertex b) {
        return a == b || graph.headingOf(a, b) != kNoHeading;
      };
      if (!is_move(other[t - 1], other[t]) || !is_move(other[t], other[t + 1])) continue;
      while (other.size() > 1 && other[other.size() - 2] == other.back()) other.pop_back();
      Plan changed = plan;
      changed.paths[robot] = other;
      const bool valid = validate(instance, changed).empty();
      ASSERT_EQ(table.exchange(plan.paths[robot], other), valid);
      EXPECT_EQ(plan.paths[robot] == changed.paths[robot],
                valid || changed.paths[robot] == plan.paths[robot]);
      (valid ? exchanged : refused) += 1;
      expectAsPlanned(*grid, table, plan);
    }
  }
  EXPECT_GT(exchanged, 300U);
  EXPECT_GT(refused, 200U);
}

}  // namespace
}  // namespace split_mapf
