#include "split_mapf/split/time_split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "split_mapf/core/random.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

TimeSplitOptions equal(std::uint32_t pieces, TimeSplitVariant variant, std::uint64_t seed = 0) {
  TimeSplitOptions options;
  options.ratios.assign(pieces, 1.0 / pieces);
  options.variant = variant;
  options.seed = seed;
  return options;
}

/// Random starts and goals on a random grid without cut-off robots.
Instance randomInstance(std::uint32_t side, double density, std::uint32_t robots,
                        std::uint64_t seed) {
  RandomEngine engine(seed);
  for (;;) {
    std::vector<bool> free(std::size_t{side} * side);
    for (std::size_t i = 0; i < free.size(); ++i) {
      free[i] = static_cast<double>(drawBelow(engine, 1000)) >= density * 1000;
    }
    const auto grid = std::make_shared<const Grid>(side, side, free);
    std::vector<Vertex> cells(grid->size());
    for (Vertex v = 0; v < cells.size(); ++v) cells[v] = v;
    shuffle(cells, engine);
    const std::vector<Vertex> starts(cells.begin(), cells.begin() + robots);
    shuffle(cells, engine);
    const std::vector<Vertex> goals(cells.begin(), cells.begin() + robots);
    Instance instance = Instance::fromVertices(grid, starts, goals);
    if (!findCutOffRobot(instance)) return instance;
  }
}

/// Where robots may be after random moves into empty cells, one robot at a time.
std::vector<Vertex> wander(const Grid& grid, std::vector<Vertex> at, int moves,
                           RandomEngine& engine) {
  for (int i = 0; i < moves; ++i) {
    Vertex& robot = at[drawBelow(engine, at.size())];
    const VertexRange around = grid.graph().neighbours(robot);
    const Vertex to = around.begin()[drawBelow(engine, around.size())];
    if (std::find(at.begin(), at.end(), to) == at.end()) robot = to;
  }
  return at;
}

class TimeSplit : public testing::TestWithParam<TimeSplitVariant> {};

TEST_P(TimeSplit, PiecesFollowEachOtherFromStartsToGoals) {
  const Instance instance = randomInstance(16, 0.1, 60, 1);
  const auto tree = splitTime(instance, equal(5, GetParam()), Deadline());
  ASSERT_TRUE(tree);
  std::vector<Vertex> at = instance.starts();
  for (const Piece& leaf : *tree) {
    EXPECT_EQ(leaf.instance->starts(), at);
    at = leaf.instance->goals();
    EXPECT_EQ(std::set<Vertex>(at.begin(), at.end()).size(), at.size());
  }
  EXPECT_EQ(at, instance.goals());
}

TEST_P(TimeSplit, LowerBoundsOfThePiecesAddUpToTheWholes) {
  for (const std::uint32_t robots : {20U, 100U, 200U}) {
    for (std::uint32_t pieces = 2; pieces <= 6; ++pieces) {
      const Instance instance = randomInstance(32, 0.05, robots, robots + pieces);
      const auto tree = splitTime(instance, equal(pieces, GetParam()), Deadline());
      std::uint32_t sum = 0;
      for (const Piece& leaf : *tree) sum += makespanLowerBound(*leaf.instance);
      EXPECT_EQ(sum, makespanLowerBound(instance)) << robots << " robots, " << pieces << " pieces";
    }
  }
}

TEST_P(TimeSplit, RatiosShareOutTheTime) {
  const Instance instance = randomInstance(32, 0.05, 50, 3);
  TimeSplitOptions options = equal(1, GetParam());
  options.ratios = {0.2, 0.3, 0.5};
  const auto tree = splitTime(instance, options, Deadline());
  const std::vector<Piece>& leaves = *tree;
  ASSERT_EQ(leaves.size(), 3U);
  const double whole = makespanLowerBound(instance);
  EXPECT_NEAR(makespanLowerBound(*leaves[0].instance), 0.2 * whole, 1);
  EXPECT_NEAR(makespanLowerBound(*leaves[1].instance), 0.3 * whole, 1);
  EXPECT_NEAR(makespanLowerBound(*leaves[2].instance), 0.5 * whole, 1);
}

TEST_P(TimeSplit, TheSameSeedGivesTheSameStates) {
  const Instance instance = randomInstance(20, 0.1, 80, 4);
  const auto states = [&](std::uint64_t seed) {
    return splitTime(instance, equal(3, GetParam(), seed), Deadline())->front().instance->goals();
  };
  EXPECT_EQ(states(7), states(7));
  EXPECT_NE(states(7), states(8));
}

TEST_P(TimeSplit, WaysDrawnBeforehandChangeNothing) {
  for (const std::uint32_t robots : {20U, 120U}) {
    const Instance instance = randomInstance(32, 0.1, robots, 4);
    const TimeSplitOptions options = equal(4, GetParam(), 5);
    EXPECT_EQ(followsShortestWays(instance, options), robots == 20);
    std::vector<Path> ways;
    for (std::uint32_t i = 0; i < robots; ++i) ways.push_back(drawShortestWay(instance, i, 5));
    const auto alone = splitTime(instance, options, Deadline());
    const auto helped = splitTime(instance, options, Deadline(), ways);
    ASSERT_EQ(alone->size(), helped->size());
    for (std::size_t j = 0; j < alone->size(); ++j) {
      EXPECT_EQ((*alone)[j].instance->goals(), (*helped)[j].instance->goals());
    }
    if (robots > 20) continue;
    // Whoever has its own way's state to itself is there.
    std::uint32_t on_way = 0;
    const std::vector<Vertex>& seam = (*helped)[0].instance->goals();
    for (std::uint32_t i = 0; i < robots; ++i) {
      on_way += std::find(ways[i].begin(), ways[i].end(), seam[i]) != ways[i].end();
    }
    EXPECT_GE(on_way, 18U);
  }
}

TEST_P(TimeSplit, CrowdedGridsStillGetStatesOfTheirOwn) {
  const Instance instance = randomInstance(8, 0, 64, 5);
  const auto tree = splitTime(instance, equal(4, GetParam()), Deadline());
  for (const Piece& leaf : *tree) EXPECT_EQ(leaf.instance->robots(), 64U);
}

TEST_P(TimeSplit, CheckedPiecesAreSolvable) {
  int refused = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    // A corridor with one siding: many intermediate states put robots in the wrong order.
    const auto grid = test::gridFromAscii({".........", "####.####"});
    RandomEngine engine(seed);
    std::vector<Vertex> cells(grid->size());
    for (Vertex v = 0; v < cells.size(); ++v) cells[v] = v;
    shuffle(cells, engine);
    const std::vector<Vertex> starts(cells.begin(), cells.begin() + 7);
    const std::vector<Vertex> goals = wander(*grid, starts, 200, engine);
    const Instance instance = Instance::fromVertices(grid, starts, goals);
    const SolvabilityChecker checker(grid->graph());
    TimeSplitOptions options = equal(3, GetParam(), seed);
    const auto unchecked = splitTime(instance, options, Deadline());
    for (const Piece& leaf : *unchecked) {
      refused += checkSolvable(*leaf.instance).answer != Solvability::kSolvable;
    }
    options.checker = &checker;
    const auto checked = splitTime(instance, options, Deadline());
    for (const Piece& leaf : *checked) {
      EXPECT_EQ(checkSolvable(*leaf.instance).answer, Solvability::kSolvable) << seed;
    }
  }
  // States at everyone's share of its way keep the order of a corridor; far ones do not.
  if (GetParam() == TimeSplitVariant::kSumOfCosts) {
    EXPECT_GT(refused, 0) << "the check had nothing to refuse";
  }
}

TEST_P(TimeSplit, MorePiecesThanStepsLeaveTheEmptyOnesOut) {
  const Instance instance = randomInstance(4, 0, 3, 6);
  const auto tree = splitTime(instance, equal(50, GetParam()), Deadline());
  EXPECT_LE(tree->size(), makespanLowerBound(instance) + 1);
  EXPECT_GE(tree->size(), 1U);
}

TEST_P(TimeSplit, AnExpiredDeadlineEndsIt) {
  const Instance instance = randomInstance(16, 0.1, 60, 1);
  EXPECT_FALSE(splitTime(instance, equal(5, GetParam()), Deadline(0)));
}

INSTANTIATE_TEST_SUITE_P(Variants, TimeSplit,
                         testing::Values(TimeSplitVariant::kMakespan, TimeSplitVariant::kSumOfCosts,
                                         TimeSplitVariant::kAhead),
                         [](const auto& info) {
                           if (info.param == TimeSplitVariant::kAhead) return "Ahead";
                           return info.param == TimeSplitVariant::kMakespan ? "Makespan"
                                                                            : "SumOfCosts";
                         });

TEST(TimeSplitAhead, NobodyIsHeldBackToTheLongestWay) {
  // b could be home within the first piece; at its share of its way it would walk four times.
  const Instance instance = test::instanceFromAscii(
      {"a...................", "b...................", "...................."},
      {"...................a", "....b...............", "...................."});
  const auto shares = splitTime(instance, equal(4, TimeSplitVariant::kMakespan), Deadline());
  const auto ahead = splitTime(instance, equal(4, TimeSplitVariant::kAhead), Deadline());
  EXPECT_NE(shares->front().instance->goal(1), instance.goal(1));
  EXPECT_EQ(ahead->front().instance->goal(1), instance.goal(1));
  std::uint32_t bounds = 0;
  for (const Piece& leaf : *ahead) bounds += makespanLowerBound(*leaf.instance);
  EXPECT_EQ(bounds, 19U);
}

void expectChain(const Instance& instance, const std::vector<Piece>& tree) {
  std::vector<Vertex> at = instance.starts();
  for (const Piece& leaf : tree) {
    EXPECT_EQ(leaf.instance->starts(), at);
    at = leaf.instance->goals();
  }
  EXPECT_EQ(at, instance.goals());
}

TEST(TimeSplit, PiecesShareNoTableThatGrows) {
  // Robot 0 is home before the last piece begins, so its goal is that of several pieces.
  const auto grid = test::gridFromAscii({".........", ".........", "........."});
  const Instance whole = Instance::fromVertices(grid, {0, 9}, {1, 17}, DistanceExtent::kOnDemand);
  TimeSplitOptions options;
  options.ratios = {0.25, 0.25, 0.5};
  options.variant = TimeSplitVariant::kSumOfCosts;
  const auto tree = splitTime(whole, options, Deadline());
  ASSERT_TRUE(tree);
  std::set<const DistanceTable*> tables;
  for (const Piece& leaf : *tree) {
    EXPECT_EQ(leaf.instance->goal(0), 1U);
    const HeldDistances distances = leaf.instance->distances(0);
    EXPECT_TRUE(tables.insert(&*distances).second) << "read by two threads";
  }
  EXPECT_EQ(tables.size(), 3U);
}

TEST(TimeSplitMatching, WastesNoStepEither) {
  for (std::uint32_t pieces = 2; pieces <= 4; ++pieces) {
    const Instance instance = randomInstance(32, 0.05, 150, pieces);
    TimeSplitOptions options = equal(pieces, TimeSplitVariant::kMakespan);
    options.assignment = StateAssignment::kMatching;
    const auto tree = splitTime(instance, options, Deadline());
    ASSERT_TRUE(tree);
    expectChain(instance, *tree);
    std::uint32_t sum = 0;
    for (const Piece& leaf : *tree) sum += makespanLowerBound(*leaf.instance);
    EXPECT_EQ(sum, makespanLowerBound(instance));
  }
}

TEST(TimeSplitMatching, CrowdedGridsStillGetStatesOfTheirOwn) {
  const Instance instance = randomInstance(8, 0, 64, 5);
  TimeSplitOptions options = equal(3, TimeSplitVariant::kSumOfCosts);
  options.assignment = StateAssignment::kMatching;
  expectChain(instance, *splitTime(instance, options, Deadline()));
}

TEST(TimeSplitBisection, HalvesAgainAndAgain) {
  const Instance instance = randomInstance(32, 0.05, 60, 11);
  const auto tree = splitTime(instance, equal(8, TimeSplitVariant::kBisection), Deadline());
  ASSERT_TRUE(tree);
  const std::vector<Piece>& leaves = *tree;
  ASSERT_EQ(leaves.size(), 8U);
  expectChain(instance, *tree);
  for (std::uint32_t i = 0; i < 8; ++i) EXPECT_EQ(leaves[i].phase, i);
}

TEST(TimeSplitSumOfCosts, SumsOfCostsOfThePiecesAddUpToTheWholes) {
  for (const std::uint32_t robots : {20U, 100U, 200U}) {
    for (std::uint32_t pieces = 2; pieces <= 6; ++pieces) {
      const Instance instance = randomInstance(32, 0.05, robots, robots + pieces);
      const auto tree =
          splitTime(instance, equal(pieces, TimeSplitVariant::kSumOfCosts), Deadline());
      std::uint64_t sum = 0;
      for (const Piece& leaf : *tree) sum += sumOfCostsLowerBound(*leaf.instance);
      EXPECT_LE(static_cast<double>(sum),
                1.001 * static_cast<double>(sumOfCostsLowerBound(instance)))
          << robots << " robots, " << pieces << " pieces";
    }
  }
}

TEST(TimeSplitSumOfCosts, RobotsNearHomeGoHomeInTheFirstPiece) {
  const Instance instance = randomInstance(32, 0, 40, 9);
  const auto tree = splitTime(instance, equal(2, TimeSplitVariant::kSumOfCosts), Deadline());
  const Instance& first = *tree->front().instance;
  const std::uint32_t half = (makespanLowerBound(instance) + 1) / 2;
  int home = 0;
  for (std::uint32_t i = 0; i < instance.robots(); ++i) {
    if (instance.shortestLength(i) > half) continue;
    if (first.goal(i) == instance.goal(i)) ++home;
  }
  EXPECT_GT(home, 10);
}

}  // namespace
}  // namespace split_mapf
