// Beyond what exhaustive search can take: what must hold on every graph, and what a check costs.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "split_mapf/core/random.h"
#include "split_mapf/io/movingai.h"
#include "split_mapf/solvability/solvability.h"
#include "support/benchmarks.h"
#include "support/solvability_cases.h"

namespace split_mapf {
namespace {

using Vertices = std::vector<Vertex>;

/// Larger graphs than exhaustive search can take, by what must not change the answer.
class LargerGraphs : public ::testing::Test {
 protected:
  void draw(std::uint64_t seed) {
    engine_.seed(seed);
    graph_ =
        test::graphOfCorridors(20 + static_cast<std::uint32_t>(drawBelow(engine_, 40)), engine_);
    order_.resize(graph_.size());
    std::iota(order_.begin(), order_.end(), 0U);
    shuffle(order_, engine_);
    const std::size_t blanks = 1 + drawBelow(engine_, 9);
    starts_.assign(order_.begin(), order_.end() - static_cast<std::ptrdiff_t>(blanks));
  }
  /// Where random single moves lead.
  Vertices wander(std::uint32_t moves) {
    std::vector<std::uint32_t> robot_at(graph_.size(), kNoVertex);
    Vertices places = starts_;
    for (std::uint32_t i = 0; i < places.size(); ++i) robot_at[places[i]] = i;
    for (std::uint32_t i = 0; i < moves; ++i) {
      const auto v = static_cast<Vertex>(drawBelow(engine_, graph_.size()));
      const VertexRange neighbours = graph_.neighbours(v);
      const Vertex u = neighbours.begin()[drawBelow(engine_, neighbours.size())];
      if (robot_at[v] != kNoVertex || robot_at[u] == kNoVertex) continue;
      std::swap(robot_at[u], robot_at[v]);
      places[robot_at[v]] = v;
    }
    return places;
  }
  /// Some robots of a place reached exchanged: often out of reach.
  Vertices disturb() {
    Vertices goals = wander(3000);
    std::swap(goals[drawBelow(engine_, goals.size())], goals[drawBelow(engine_, goals.size())]);
    return goals;
  }

  RandomEngine engine_{0};
  Graph graph_;
  Vertices order_;
  Vertices starts_;
};

TEST_F(LargerGraphs, WhatWasReachedIsSolvable) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    draw(seed);
    const Vertices goals = wander(5000);
    ASSERT_EQ(checkSolvable(graph_, starts_, goals).answer, Solvability::kSolvable)
        << "seed " << seed << test::describe(graph_, starts_, goals);
  }
}

TEST_F(LargerGraphs, TheAnswerDoesNotDependOnNumbersDirectionOrLegalMoves) {
  int refused = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    draw(seed);
    const Vertices goals = disturb();
    const Solvability answer = checkSolvable(graph_, starts_, goals).answer;
    refused += answer == Solvability::kUnsolvable ? 1 : 0;
    EXPECT_EQ(checkSolvable(graph_, goals, starts_).answer, answer) << "seed " << seed;
    EXPECT_EQ(checkSolvable(graph_, wander(2000), goals).answer, answer) << "seed " << seed;
    Vertices number(graph_.size());
    std::iota(number.begin(), number.end(), 0U);
    shuffle(number, engine_);
    std::vector<std::pair<Vertex, Vertex>> edges;
    for (Vertex v = 0; v < graph_.size(); ++v) {
      for (const Vertex u : graph_.neighbours(v)) edges.emplace_back(number[v], number[u]);
    }
    Vertices starts = starts_;
    Vertices renumbered = goals;
    for (Vertex& v : starts) v = number[v];
    for (Vertex& v : renumbered) v = number[v];
    EXPECT_EQ(checkSolvable(Graph(graph_.size(), edges), starts, renumbered).answer, answer)
        << "seed " << seed;
  }
  EXPECT_GT(refused, 50);
  EXPECT_LT(refused, 350);
}

TEST_F(LargerGraphs, TakingARobotAwayNeverHurts) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    draw(seed);
    Vertices goals = disturb();
    Solvability before = Solvability::kUnsolvable;
    while (!starts_.empty()) {
      const Solvability answer = checkSolvable(graph_, starts_, goals).answer;
      if (before == Solvability::kSolvable) {
        ASSERT_EQ(answer, before) << "seed " << seed;
      }
      before = answer;
      starts_.pop_back();
      goals.pop_back();
    }
    EXPECT_EQ(before, Solvability::kSolvable) << "a single robot goes where it wants";
  }
}

TEST(SolvabilityCost, BenchmarkMapsTakeMilliseconds) {
  for (const char* name : {"Berlin_1_256", "brc202d", "den520d", "ost003d", "room-64-64-8",
                           "maze-32-32-4", "random-32-32-20", "warehouse-10-20-10-2-1"}) {
    const std::string stem = std::string("movingai/") + name;
    const auto map = test::benchmarkFile(stem + ".map");
    const auto scenario = test::benchmarkFile(stem + "-random-1.scen");
    if (!map || !scenario) GTEST_SKIP() << test::benchmarkMissing(stem);
    const auto grid = readMovingAiMap(*map);
    const Scenario robots = readMovingAiScenario(*scenario, *grid);
    const Instance instance(grid, robots.starts, robots.goals);
    double least_sec = 1e9;
    for (int repeat = 0; repeat < 5; ++repeat) {
      const auto begin = std::chrono::steady_clock::now();
      EXPECT_EQ(checkSolvable(instance).answer, Solvability::kSolvable) << name;
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
      least_sec = std::min(least_sec, seconds.count());
    }
    EXPECT_LT(least_sec, 0.05) << name;
  }
}

TEST(SolvabilityCost, AMillionVerticesTakeNoRecursionAndLittleTime) {
  // A triangle at the end of a corridor of a million vertices, half of them empty.
  constexpr Vertex kSize = 1000000;
  std::vector<std::pair<Vertex, Vertex>> edges = {{0, 2}};
  for (Vertex v = 0; v + 1 < kSize; ++v) edges.emplace_back(v, v + 1);
  const Graph graph(kSize, edges);
  Vertices starts(kSize / 2);
  std::iota(starts.begin(), starts.end(), kSize / 2);
  Vertices goals(starts.rbegin(), starts.rend());
  const auto begin = std::chrono::steady_clock::now();
  const SolvabilityVerdict verdict = checkSolvable(graph, starts, goals);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  EXPECT_EQ(verdict.refusal, RefusalKind::kClassMismatch);
  EXPECT_EQ(verdict.blanks, kSize / 2);
  EXPECT_EQ(verdict.blanks_needed, kSize - 3);
  // Measured 0.2 s; b shifts along the corridor would take minutes.
  EXPECT_LT(seconds.count(), 20.0);
}

}  // namespace
}  // namespace split_mapf
