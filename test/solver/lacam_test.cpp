#include "split_mapf/solver/lacam.h"

#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <map>
#include <memory>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "search/explored.h"
#include "solver/lacam/guidance.h"
#include "solver/lacam/pibt.h"
#include "split_mapf/core/random.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/parallel/executor.h"
#include "support/ascii_grid.h"
#include "support/long_run.h"
#include "support/oracle_cases.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

using test::instanceFromAscii;
using Values = std::map<std::string, std::string>;

SolveResult solve(const Instance& instance, Values values = {},
                  Objective objective = Objective::kSumOfCosts,
                  const Deadline& deadline = Deadline(20)) {
  SolverOptions options;
  options.objective = objective;
  options.values = std::move(values);
  return LacamSolver(options).solve(instance, deadline);
}

void expectSolved(const Instance& instance, const SolveResult& result) {
  ASSERT_EQ(result.termination, Termination::kSolved) << result.message;
  for (const Violation& violation : validate(instance, *result.plan)) {
    ADD_FAILURE() << violation.message;
  }
}

/// All cells taken; goals are starts in a random order.
Instance fullGrid(std::uint32_t width, std::uint32_t height, std::uint64_t seed) {
  auto grid = std::make_shared<const Grid>(width, height,
                                           std::vector<bool>(std::size_t{width} * height, true));
  std::vector<Vertex> starts(grid->size());
  std::iota(starts.begin(), starts.end(), 0U);
  std::vector<Vertex> goals = starts;
  RandomEngine engine(seed);
  shuffle(goals, engine);
  return Instance::fromVertices(std::move(grid), starts, goals);
}

TEST(Lacam, FindsAPlanOrProvesThatThereIsNoneBySearchAlone) {
  int solved = 0;
  int unsolvable = 0;
  for (const test::OracleCase& c : test::oracleCases()) {
    SCOPED_TRACE("seed " + std::to_string(c.seed) + test::describe(c.instance));
    const SolveResult result = solve(c.instance, {{"check", "false"}});
    if (c.sum_of_costs) {
      expectSolved(c.instance, result);
      EXPECT_GE(sumOfCostsOf(*result.plan), *c.sum_of_costs);
      ++solved;
    } else {
      EXPECT_EQ(result.termination, Termination::kUnsolvable);
      EXPECT_FALSE(result.message.empty());
      ++unsolvable;
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(solved, test::draws(200));
  EXPECT_GT(unsolvable, test::draws(20));
}

TEST(Lacam, TechniquesOnlyMakeItFasterNeverWrong) {
  const std::vector<Values> variants = {{{"guidance", "0"}, {"swap", "false"}},
                                        {{"guidance", "0"}, {"polish", "0"}},
                                        {{"swap", "false"}, {"margin", "0"}}};
  for (const test::OracleCase& c : test::oracleCases()) {
    if (!c.sum_of_costs) continue;
    for (const Values& values : variants) {
      SCOPED_TRACE(test::describe(c.instance));
      expectSolved(c.instance, solve(c.instance, values, Objective::kMakespan));
      if (HasFailure()) return;
    }
  }
}

TEST(Lacam, ARingWithoutAnEmptyCellTurns) {
  const Instance instance = instanceFromAscii({"ab", "dc"}, {"da", "cb"});
  const SolveResult result = solve(instance, {}, Objective::kMakespan);
  expectSolved(instance, result);
  EXPECT_EQ(makespanOf(*result.plan), 1U);
  EXPECT_TRUE(result.optimal);
  EXPECT_EQ(result.certified_by, "lacam");
}

TEST(Lacam, FullGridsAreReorderedByRotations) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (const auto& [width, height] : {std::pair(3U, 2U), std::pair(3U, 3U)}) {
      const Instance instance = fullGrid(width, height, seed);
      SCOPED_TRACE(test::describe(instance));
      expectSolved(instance, solve(instance));
      if (HasFailure()) return;
    }
  }
}

TEST(Lacam, AFullRingOutOfOrderIsRefusedWithAndWithoutSearch) {
  const Instance instance = instanceFromAscii({"ab", "dc"}, {"ba", "dc"});
  EXPECT_EQ(solve(instance).termination, Termination::kUnsolvable);
  EXPECT_EQ(solve(instance, {{"check", "false"}}).termination, Termination::kUnsolvable);
}

TEST(Lacam, RobotsPassEachOtherInALongCorridorWithASiding) {
  const Instance instance = instanceFromAscii({"##########.##", "a...........b", "#############"},
                                              {"##########.##", "b...........a", "#############"});
  const SolveResult with = solve(instance);
  expectSolved(instance, with);
  const SolveResult without = solve(instance, {{"swap", "false"}});
  expectSolved(instance, without);
  EXPECT_LT(with.high_level_nodes, without.high_level_nodes) << "the swap rule has no effect";
}

TEST(Lacam, PolishNeverMakesThePlanWorse) {
  const Instance instance = test::generatedInstance(24, 0.1, 200);
  const SolveResult raw = solve(instance, {{"polish", "0"}});
  const SolveResult polished = solve(instance, {{"polish", "2"}});
  expectSolved(instance, raw);
  expectSolved(instance, polished);
  EXPECT_LT(sumOfCostsOf(*polished.plan), sumOfCostsOf(*raw.plan));
  EXPECT_LE(makespanOf(*polished.plan), makespanOf(*raw.plan));
}

TEST(Lacam, TheSeedDecides) {
  const Instance instance = test::generatedInstance(24, 0.1, 150);
  SolverOptions options;
  options.seed = 5;
  const SolveResult first = LacamSolver(options).solve(instance, Deadline());
  const SolveResult again = LacamSolver(options).solve(instance, Deadline());
  options.seed = 6;
  const SolveResult other = LacamSolver(options).solve(instance, Deadline());
  ASSERT_TRUE(first.plan && again.plan && other.plan);
  EXPECT_EQ(first.plan->paths, again.plan->paths);
  EXPECT_NE(first.plan->paths, other.plan->paths);
}

TEST(Lacam, GivesUpAtTheExpansionLimit) {
  SolverOptions options;
  options.expansion_limit = 500;
  const SolveResult result =
      LacamSolver(options).solve(test::generatedInstance(24, 0.1, 200), Deadline());
  EXPECT_EQ(result.termination, Termination::kNoPlanFound);
  EXPECT_NE(result.message.find("500 expansions"), std::string::npos) << result.message;
}

/// Unsolvable, as y and z cannot pass each other on a full map with bridges, and far too large for
/// a proof by search.
Instance endless() {
  return instanceFromAscii({"abcdefgh", "ijklmnop", "qrstuvwx", "###.####", "###yz###"},
                           {"abcdefgh", "ijklmnop", "qrstuvwx", "###.####", "###zy###"});
}

TEST(Lacam, GivesUpWhenItsMemoryIsFull) {
  const SolveResult result = solve(endless(), {{"check", "false"}, {"memory", "1"}});
  EXPECT_EQ(result.termination, Termination::kNoPlanFound);
  EXPECT_NE(result.message.find("1 MiB"), std::string::npos) << result.message;
}

TEST(Lacam, StopsWithin200MillisecondsOfACancellation) {
  auto stop = std::make_shared<StopFlag>();
  auto answer = std::async(std::launch::async, [&] {
    return solve(endless(), {{"check", "false"}, {"memory", "4000"}}, Objective::kMakespan,
                 Deadline(60, stop));
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const auto raised = Deadline::Clock::now();
  stop->request();
  EXPECT_EQ(answer.get().termination, Termination::kCancelled);
  EXPECT_LT(std::chrono::duration<double>(Deadline::Clock::now() - raised).count(), 0.2);
}

TEST(Explored, TellsConfigurationsOfEqualHashesApart) {
  Explored explored(2, 70000);
  EXPECT_EQ(explored.add({1, 69999}, 7), 0U);
  EXPECT_EQ(explored.add({69999, 1}, 7), 1U);
  EXPECT_EQ(explored.find({69999, 1}, 7).value(), 1U);
  EXPECT_EQ(explored.find({1, 69999}, 7).value(), 0U);
  EXPECT_FALSE(explored.find({1, 2}, 7));
  Configuration read;
  explored.read(0, read);
  EXPECT_EQ(read, (Configuration{1, 69999}));
}

TEST(Explored, FindsThousandsAgain) {
  Explored explored(3, 1000);
  for (Vertex v = 0; v < 5000; ++v) {
    const Configuration c = {v % 1000, v / 1000, 7};
    explored.add(c, hashOf(c));
  }
  for (Vertex v = 0; v < 5000; ++v) {
    const Configuration c = {v % 1000, v / 1000, 7};
    ASSERT_EQ(explored.find(c, hashOf(c)).value(), v);
  }
}

TEST(Guidance, LeadsAlongThePathAndNowhereElse) {
  const Guidance guidance({{4, 7, 2, 9}, {}});
  EXPECT_EQ(guidance.next(0, 4), 7U);
  EXPECT_EQ(guidance.next(0, 2), 9U);
  EXPECT_EQ(guidance.next(0, 9), kNoVertex);
  EXPECT_EQ(guidance.next(0, 5), kNoVertex);
  EXPECT_EQ(guidance.next(1, 4), kNoVertex);
}

TEST(Guidance, TwoRobotsThatMeetHeadOnTakeDifferentRows) {
  const Instance instance = instanceFromAscii({"..........", "a........b", ".........."},
                                              {"..........", "b........a", ".........."});
  const ScatteredPaths scattered = scatterPaths(instance, {}, Deadline());
  ASSERT_EQ(scattered.paths[0].size() + scattered.paths[1].size(), 22U) << "one goes round";
  ScatterOptions straight;
  straight.margin = 0;
  for (const Path& path : scatterPaths(instance, straight, Deadline()).paths) {
    EXPECT_EQ(path.size(), 10U);
  }
}

TEST(Guidance, BatchesAreTheSameOnAnyNumberOfThreads) {
  const Instance instance = test::generatedInstance(30, 0.1, 150);
  ScatterOptions options;
  options.batch = 16;
  const ScatteredPaths alone = scatterPaths(instance, options, Deadline());
  Executor executor(3);
  options.threads = executor.lend(3);
  const ScatteredPaths together = scatterPaths(instance, options, Deadline());
  EXPECT_EQ(together.paths, alone.paths);
  EXPECT_EQ(together.expansions, alone.expansions);
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    ASSERT_FALSE(alone.paths[robot].empty());
    EXPECT_EQ(alone.paths[robot].front(), instance.start(robot));
    EXPECT_EQ(alone.paths[robot].back(), instance.goal(robot));
  }
}

TEST(Pibt, KeepsFixedPlacesAndRefusesSwaps) {
  const Instance instance = instanceFromAscii({"ab.", "..."}, {".ab", "..."});
  const RobotDistances distances(instance);
  Pibt pibt(instance, distances, nullptr, true, 0);
  const Configuration& from = instance.starts();
  Configuration next = {1, kNoVertex};
  ASSERT_TRUE(pibt.complete(from, {0, 1}, next));
  EXPECT_EQ(next[0], 1U);
  EXPECT_NE(next[1], 0U);
  next = {1, 0};
  EXPECT_FALSE(pibt.complete(from, {0, 1}, next));
  next = {0, 0};
  EXPECT_FALSE(pibt.complete(from, {0, 1}, next));
  next = {kNoVertex, kNoVertex};
  EXPECT_TRUE(pibt.complete(from, {0, 1}, next)) << "a failed call leaves nothing behind";
}

}  // namespace
}  // namespace split_mapf
