#include "split_mapf/core/precedence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "split_mapf/core/validate.h"
#include "support/ascii_grid.h"
#include "support/random_plan.h"

namespace split_mapf {
namespace {

TEST(Precedence, VisitsLeaveWaitsOut) {
  const Precedence precedence(Plan{{{0, 0, 1, 1, 2}, {3, 3, 3, 4}}}, 5);
  ASSERT_EQ(precedence.size(), 5U);
  ASSERT_EQ(precedence.robots(), 2U);
  EXPECT_EQ(precedence[0].vertex, 0U);
  EXPECT_EQ(precedence[1].step, 2U);
  EXPECT_EQ(precedence[2].step, 4U);
  EXPECT_EQ(precedence.first(1), 3U);
  EXPECT_EQ(precedence.last(1), 4U);
  EXPECT_EQ(precedence[4].robot, 1U);
  EXPECT_EQ(precedence[4].step, 3U);
}

TEST(Precedence, AnEventAwaitsTheOneThatEndsTheVisitBefore) {
  // Robot 1 passes vertex 1 before robot 0 comes there.
  const Precedence precedence(Plan{{{0, 0, 0, 0, 1}, {4, 3, 1, 2}}}, 5);
  const VisitId last_of_0 = precedence.last(0);
  EXPECT_EQ(precedence[last_of_0].before, precedence.first(1) + 2);
  EXPECT_EQ(precedence.awaits(last_of_0), precedence.last(1));
  EXPECT_EQ(precedence.awaitedBy(precedence.last(1)), last_of_0);
  EXPECT_EQ(precedence.awaits(precedence.last(1)), kNoVisit);
  EXPECT_EQ(precedence.awaitedBy(precedence.first(1)), kNoVisit);
}

TEST(Precedence, TwentyBytesAVisit) { EXPECT_EQ(sizeof(Visit), 20U); }

TEST(Precedence, FindsRingsAndNoChains) {
  const Plan plan = {{{0, 0, 1}, {1, 1, 2}, {2, 2, 3}, {3, 3, 0}, {5, 4, 6}, {6, 5, 4}}};
  const std::vector<Ring> rings = findRings(Precedence(plan, 7));
  ASSERT_EQ(rings.size(), 1U);
  const Precedence precedence(plan, 7);
  std::set<std::uint32_t> robots;
  for (const VisitId event : rings.front()) {
    EXPECT_EQ(precedence[event].step, 2U);
    robots.insert(precedence[event].robot);
  }
  EXPECT_EQ(robots, (std::set<std::uint32_t>{0, 1, 2, 3}));
}

TEST(Precedence, RobotsDepartNoSooner) {
  // Robot 1 follows robot 0, which stands for three steps more.
  const Precedence precedence(Plan{{{1, 2, 3}, {0, 1, 2}}}, 4);
  const Plan plan = planOf(precedence, earliestSteps(precedence, {3, 0}));
  EXPECT_EQ(plan.paths[0], (Path{1, 1, 1, 1, 2, 3}));
  EXPECT_EQ(plan.paths[1], (Path{0, 0, 0, 0, 1, 2}));
}

/// Plays the visits step by step, all robots that can move moving: those whose next vertex has seen
/// all its earlier visitors and is free, or is left in this very step.
Plan playStepByStep(const Plan& plan, const std::vector<std::uint32_t>& departures) {
  std::map<Vertex, std::vector<std::uint32_t>> order;  // of visitors
  std::vector<Path> route(plan.paths.size());
  for (std::uint32_t t = 0; t <= makespanOf(plan); ++t) {
    for (std::uint32_t i = 0; i < plan.paths.size(); ++i) {
      const Vertex v = positionAt(plan.paths[i], t);
      if (t > 0 && v == positionAt(plan.paths[i], t - 1)) continue;
      order[v].push_back(i);
      route[i].push_back(v);
    }
  }
  std::map<Vertex, std::size_t> left;  // visits that are over
  std::vector<std::size_t> at(plan.paths.size(), 0);
  Plan played;
  for (const Path& way : route) played.paths.push_back({way.front()});
  for (std::uint32_t t = 0;; ++t) {
    std::vector<bool> moves(route.size());
    bool under_way = false;
    for (std::uint32_t i = 0; i < route.size(); ++i) {
      const bool more = at[i] + 1 < route[i].size();
      under_way = under_way || more;
      moves[i] = more && (at[i] > 0 || t >= departures[i]);
    }
    if (!under_way) return played;
    for (bool changed = true; changed;) {
      changed = false;
      for (std::uint32_t i = 0; i < route.size(); ++i) {
        if (!moves[i]) continue;
        const Vertex to = route[i][at[i] + 1];
        const std::vector<std::uint32_t>& visitors = order[to];
        std::size_t rank = left[to];
        for (std::uint32_t j = 0; j < route.size(); ++j) {
          if (moves[j] && route[j][at[j]] == to) ++rank;
        }
        moves[i] = rank < visitors.size() && visitors[rank] == i;
        changed = changed || !moves[i];
      }
    }
    for (std::uint32_t i = 0; i < route.size(); ++i) {
      if (moves[i]) ++left[route[i][at[i]++]];
      if (moves[i] || at[i] + 1 < route[i].size()) played.paths[i].push_back(route[i][at[i]]);
    }
  }
}

TEST(Precedence, EarliestStepsAreThoseOfAStepwisePlay) {
  std::size_t rings = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    const auto grid = test::gridFromAscii(
        seed % 2 == 0 ? std::vector<std::string>{"....", "....", "..#."}
                      : std::vector<std::string>{".....", ".#.#.", ".....", ".#.#.", "....."});
    const auto robots = static_cast<std::uint32_t>(1 + drawBelow(engine, grid->size()));
    const Plan plan = test::randomValidPlan(*grid, robots, 15, engine);
    std::vector<std::uint32_t> departures(robots, 0);
    if (seed % 3 == 0) {
      for (std::uint32_t& step : departures) {
        step = static_cast<std::uint32_t>(drawBelow(engine, 6));
      }
    }
    const Precedence precedence(plan, grid->size());
    rings += findRings(precedence).size();
    const Plan early = planOf(precedence, earliestSteps(precedence, departures));
    EXPECT_EQ(early.paths, playStepByStep(plan, departures).paths);
    EXPECT_TRUE(validate(test::instanceOf(grid, plan), early).empty());
  }
  EXPECT_GE(rings, 10U);
}

/// Proof obligation (a): edges never go back in plan time, and with rings contracted there is no
/// cycle: events can be taken away one by one, or ring by ring, until none is left.
TEST(Precedence, IsAcyclicWithRingsTakenAsOne) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    const auto grid = test::gridFromAscii({"....", "....", "...."});
    const auto robots = static_cast<std::uint32_t>(4 + drawBelow(engine, grid->size() - 4));
    const Plan plan = test::randomValidPlan(*grid, robots, 12, engine);
    const Precedence precedence(plan, grid->size());
    std::vector<std::size_t> group(precedence.size());
    for (VisitId v = 0; v < precedence.size(); ++v) group[v] = v;
    for (const Ring& ring : findRings(precedence)) {
      EXPECT_GE(ring.size(), 4U);
      for (const VisitId event : ring) group[event] = ring.front();
    }
    std::map<std::size_t, std::set<std::size_t>> follows;
    for (VisitId v = 0; v < precedence.size(); ++v) {
      const VisitId awaited = precedence.awaits(v);
      follows[group[v]];
      if (!precedence.isFirst(v)) {
        EXPECT_LT(precedence[v - 1].step, precedence[v].step);
        follows[group[v]].insert(group[v - 1]);
      }
      if (awaited == kNoVisit) continue;
      ASSERT_EQ(precedence[awaited - 1].vertex, precedence[v].vertex);
      EXPECT_LE(precedence[awaited].step, precedence[v].step);
      if (group[awaited] != group[v]) follows[group[v]].insert(group[awaited]);
    }
    for (std::size_t before = 0; before != follows.size();) {
      before = follows.size();
      for (auto event = follows.begin(); event != follows.end();) {
        const bool ready =
            std::all_of(event->second.begin(), event->second.end(),
                        [&](std::size_t other) { return follows.count(other) == 0; });
        event = ready ? follows.erase(event) : std::next(event);
      }
    }
    EXPECT_TRUE(follows.empty());
  }
}

}  // namespace
}  // namespace split_mapf
