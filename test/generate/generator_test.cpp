#include "split_mapf/generate/generator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/random.h"

namespace split_mapf {
namespace {

constexpr MapKind kKinds[] = {MapKind::kRandom, MapKind::kWarehouse, MapKind::kRooms};

GeneratorOptions optionsOf(MapKind kind, std::uint32_t width, std::uint32_t height,
                           std::uint32_t robots, std::uint64_t seed = 0) {
  GeneratorOptions options;
  options.kind = kind;
  options.width = width;
  options.height = height;
  options.robots = robots;
  options.seed = seed;
  return options;
}

/// A number for everything in a problem (FNV-1a).
std::uint64_t fingerprint(const GeneratedProblem& problem) {
  std::uint64_t hash = 14695981039346656037ULL;
  const auto add = [&](Cell c) {
    for (const std::int32_t part : {c.x, c.y}) {
      hash = (hash ^ static_cast<std::uint32_t>(part)) * 1099511628211ULL;
    }
  };
  for (Vertex v = 0; v < problem.grid->size(); ++v) add(problem.grid->cellOf(v));
  for (const Cell c : problem.starts) add(c);
  for (const Cell c : problem.goals) add(c);
  return hash;
}

std::string refusalOf(const GeneratorOptions& options) {
  try {
    generateProblem(options);
  } catch (const OptionError& e) {
    return e.what();
  }
  return "";
}

TEST(Generator, EveryKindGivesAWellPosedInstanceWithoutCutOffRobots) {
  for (const MapKind kind : kKinds) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const GeneratedProblem problem = generateProblem(optionsOf(kind, 61, 43, 200, seed));
      EXPECT_EQ(problem.grid->width(), 61U);
      EXPECT_EQ(problem.grid->height(), 43U);
      const Instance instance(problem.grid, problem.starts, problem.goals);
      EXPECT_EQ(instance.robots(), 200U);
      EXPECT_FALSE(findCutOffRobot(instance)) << toString(kind) << " seed " << seed;
    }
  }
}

// Platforms and standard libraries have to agree: these numbers must never change.
TEST(Generator, GivesTheSameProblemOnEveryPlatform) {
  EXPECT_EQ(fingerprint(generateProblem(optionsOf(MapKind::kRandom, 32, 32, 50, 7))),
            8901242487020185495ULL);
  EXPECT_EQ(fingerprint(generateProblem(optionsOf(MapKind::kWarehouse, 48, 32, 50, 7))),
            10417482112487134298ULL);
  EXPECT_EQ(fingerprint(generateProblem(optionsOf(MapKind::kRooms, 48, 32, 50, 7))),
            14020287420040310083ULL);
}

TEST(Generator, AnotherSeedGivesAnotherProblem) {
  for (const MapKind kind : kKinds) {
    EXPECT_NE(fingerprint(generateProblem(optionsOf(kind, 40, 40, 20, 1))),
              fingerprint(generateProblem(optionsOf(kind, 40, 40, 20, 2))));
  }
}

TEST(Generator, BlocksExactlyTheShareAskedFor) {
  for (const double density : {0.0, 0.05, 0.1, 0.333, 0.5}) {
    GeneratorOptions options = optionsOf(MapKind::kRandom, 30, 20, 1);
    options.density = density;
    EXPECT_EQ(600 - generateProblem(options).grid->size(),
              static_cast<std::uint32_t>(std::lround(density * 600)));
  }
}

TEST(Generator, SpreadsObstaclesEvenly) {
  std::vector<int> blocked(16, 0);
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    GeneratorOptions options = optionsOf(MapKind::kRandom, 4, 4, 1, seed);
    options.density = 0.25;
    const GeneratedProblem problem = generateProblem(options);
    for (int i = 0; i < 16; ++i) blocked[i] += problem.grid->isFree({i % 4, i / 4}) ? 0 : 1;
  }
  // 500 expected, standard deviation about 19.
  for (const int count : blocked) EXPECT_NEAR(count, 500, 100);
}

TEST(Generator, DrawsStartsAndGoalsFromTheLargestPartOnly) {
  int cut_maps = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    GeneratorOptions options = optionsOf(MapKind::kRandom, 12, 12, 10, seed);
    options.density = 0.45;
    const GeneratedProblem problem = generateProblem(options);
    const Instance instance(problem.grid, problem.starts, problem.goals);
    const HeldDistances table = instance.distances(0);
    std::uint32_t reachable = 0;
    for (Vertex v = 0; v < problem.grid->size(); ++v) {
      reachable += table(v) == DistanceTable::kUnreachable ? 0 : 1;
    }
    cut_maps += reachable < problem.grid->size() ? 1 : 0;
    EXPECT_FALSE(findCutOffRobot(instance));
    for (const Vertex v : instance.starts()) EXPECT_NE(table(v), DistanceTable::kUnreachable);
  }
  EXPECT_GT(cut_maps, 25);
}

TEST(Generator, DrawsRobotsOnAMapThatIsThere) {
  const GeneratorOptions options = optionsOf(MapKind::kRooms, 40, 30, 1);
  const auto grid = generateProblem(options).grid;
  const GeneratedProblem problem = drawRobots(grid, 200, 5);
  EXPECT_EQ(problem.grid, grid);
  const Instance instance(grid, problem.starts, problem.goals);
  EXPECT_EQ(instance.robots(), 200U);
  EXPECT_EQ(drawRobots(grid, 200, 5).goals, problem.goals);
  EXPECT_NE(drawRobots(grid, 200, 6).goals, problem.goals);
  EXPECT_THROW(drawRobots(grid, 0, 5), OptionError);
  EXPECT_THROW(drawRobots(grid, grid->size() + 1, 5), OptionError);
}

TEST(Generator, FillsEveryCellWhenAsked) {
  GeneratorOptions options = optionsOf(MapKind::kRandom, 5, 4, 20);
  options.density = 0;
  const GeneratedProblem problem = generateProblem(options);
  std::set<std::pair<int, int>> starts;
  for (const Cell c : problem.starts) starts.emplace(c.x, c.y);
  EXPECT_EQ(starts.size(), 20U);
}

TEST(Generator, WarehousesHaveShelvesAislesAndStations) {
  const GeneratedProblem problem = generateProblem(optionsOf(MapKind::kWarehouse, 60, 40, 1));
  const Grid& grid = *problem.grid;
  EXPECT_FALSE(grid.isFree({7, 2}));   // a shelf's corner
  EXPECT_FALSE(grid.isFree({16, 3}));  // its opposite corner
  EXPECT_TRUE(grid.isFree({17, 2}));   // the aisle beside it
  EXPECT_TRUE(grid.isFree({7, 4}));    // and below it
  EXPECT_FALSE(grid.isFree({0, 2}));   // stations at both edges
  EXPECT_FALSE(grid.isFree({59, 2}));
  EXPECT_TRUE(grid.isFree({2, 2}));
}

TEST(Generator, RoomsAreWalledAndConnectedByDoors) {
  for (const auto& [width, height] : {std::pair{5U, 5U}, {17U, 9U}, {65U, 40U}, {256U, 256U}}) {
    const GeneratedProblem problem = generateProblem(optionsOf(MapKind::kRooms, width, height, 1));
    const Grid& grid = *problem.grid;
    for (std::int32_t x = 0; x < static_cast<std::int32_t>(width); ++x) {
      EXPECT_FALSE(grid.isFree({x, 0}));
      EXPECT_FALSE(grid.isFree({x, static_cast<std::int32_t>(height) - 1}));
    }
    const DistanceTable table(grid.graph(), 0);
    for (Vertex v = 0; v < grid.size(); ++v) ASSERT_NE(table(v), DistanceTable::kUnreachable);
  }
}

TEST(Generator, RefusesImpossibleWishes) {
  GeneratorOptions crowded = optionsOf(MapKind::kRandom, 4, 4, 17);
  crowded.density = 0;
  EXPECT_NE(refusalOf(crowded).find("17 robots"), std::string::npos);
  EXPECT_NE(refusalOf(crowded).find("16 cells"), std::string::npos);
  EXPECT_NE(refusalOf(optionsOf(MapKind::kRandom, 4, 4, 0)), "");
  EXPECT_NE(refusalOf(optionsOf(MapKind::kRandom, 0, 4, 1)).find("width 0"), std::string::npos);
  EXPECT_NE(refusalOf(optionsOf(MapKind::kRandom, 4, 40000, 1)).find("height 40000"),
            std::string::npos);
  EXPECT_NE(refusalOf(optionsOf(MapKind::kWarehouse, 23, 40, 1)).find("24"), std::string::npos);
  EXPECT_NE(refusalOf(optionsOf(MapKind::kRooms, 4, 40, 1)).find("width 4"), std::string::npos);
  for (const double density : {-0.1, 1.0, 2.0, std::nan("")}) {
    GeneratorOptions options = optionsOf(MapKind::kRandom, 4, 4, 1);
    options.density = density;
    EXPECT_NE(refusalOf(options).find("density"), std::string::npos) << density;
  }
  GeneratorOptions rooms = optionsOf(MapKind::kRooms, 40, 40, 1);
  rooms.density = 0.1;
  EXPECT_NE(refusalOf(rooms).find("rooms"), std::string::npos);
}

TEST(Generator, ReadsAndWritesKinds) {
  for (const MapKind kind : kKinds) EXPECT_EQ(parseMapKind(toString(kind)), kind);
  EXPECT_THROW(parseMapKind("maze"), OptionError);
}

TEST(Random, DrawsEveryNumberBelowTheBoundEquallyOften) {
  RandomEngine engine(3);
  std::vector<int> counts(5, 0);
  for (int i = 0; i < 10000; ++i) ++counts.at(drawBelow(engine, 5));
  for (const int count : counts) EXPECT_NEAR(count, 2000, 200);
}

}  // namespace
}  // namespace split_mapf
