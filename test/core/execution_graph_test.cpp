#include "split_mapf/core/execution_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <map>
#include <set>

#include "split_mapf/core/error.h"
#include "split_mapf/core/execution_cut.h"
#include "split_mapf/core/execution_forecast.h"
#include "split_mapf/core/release_fraction.h"
#include "split_mapf/core/validate.h"
#include "support/ascii_grid.h"
#include "support/long_run.h"
#include "support/random_plan.h"

namespace split_mapf {
namespace {

ExecutionGraph graphOf(const Plan& plan, std::uint32_t vertices, double release) {
  return ExecutionGraph(Precedence(plan, vertices), release);
}

TEST(ReleaseFraction, IsTwoRadiiOfACell) {
  EXPECT_DOUBLE_EQ(releaseFraction(0.25, 1), 0.5);
  EXPECT_DOUBLE_EQ(releaseFraction(0, 1), 0);
  EXPECT_THROW(releaseFraction(0.4, 1), OptionError);
  EXPECT_THROW(releaseFraction(-1, 1), OptionError);
}

TEST(ReleaseFraction, KeepsTheDistanceOnAnyPairOfEdges) {
  RandomEngine engine(3);
  const auto draw = [&] { return static_cast<double>(drawBelow(engine, 2001)) / 1000 - 1; };
  for (int i = 0; i < 2000; ++i) {
    const PlanePoint from{draw() * 2, draw() * 2};
    const PlanePoint to{draw() * 2, draw() * 2};
    const double distance = 0.1 + draw() * draw();
    if (std::hypot(from.x, from.y) < 0.1 || std::hypot(to.x, to.y) < 0.1 || distance <= 0) continue;
    const double fraction = releaseFraction(from, {0, 0}, to, distance);
    const auto least = [&](double p) {
      double nearest = 1e9;
      for (int k = 0; k <= 1000; ++k) {
        const double q = k / 1000.0;  // of the follower's edge
        nearest =
            std::min(nearest, std::hypot(p * to.x - (1 - q) * from.x, p * to.y - (1 - q) * from.y));
      }
      return nearest;
    };
    if (fraction > 1) {
      EXPECT_LT(least(1), distance + 1e-3);
      continue;
    }
    for (int k = 0; k <= 20; ++k) {
      EXPECT_GE(least(fraction + (1 - fraction) * k / 20), distance - 1e-6);
    }
    EXPECT_LT(least(0.98 * fraction), distance + 1e-3) << "released later than need be";
  }
}

TEST(ExecutionGraph, ReleasesAtTheFraction) {
  // Robot 1 follows robot 0.
  ExecutionGraph graph = graphOf({{{1, 2, 3}, {0, 1, 2}}}, 4, 0.7);
  const VisitId first = graph.precedence().first(0);
  const VisitId second = graph.precedence().first(1);
  EXPECT_TRUE(graph.isReleased(first + 1));
  EXPECT_FALSE(graph.isReleased(second + 1));
  std::vector<VisitId> freed;
  EXPECT_EQ(graph.report(0, first + 1, 0.6, &freed), ReportOutcome::kTaken);
  EXPECT_FALSE(graph.isReleased(second + 1));
  EXPECT_TRUE(freed.empty());
  EXPECT_EQ(graph.report(0, first + 1, 0.7, &freed), ReportOutcome::kTaken);
  EXPECT_TRUE(graph.isReleased(second + 1));
  EXPECT_EQ(freed, std::vector<VisitId>{second + 1});
  EXPECT_EQ(graph.report(0, first + 1, 1, &freed), ReportOutcome::kTaken);
  EXPECT_EQ(freed.size(), 1U) << "freed twice";
  EXPECT_FALSE(graph.isDone(0));
  EXPECT_EQ(graph.at(0), first + 1);
}

TEST(ExecutionGraph, RefusesReportsThatCannotBe) {
  ExecutionGraph graph = graphOf({{{1, 2, 3}, {0, 1, 2}}}, 4, 0.5);
  EXPECT_EQ(graph.report(1, graph.precedence().first(1) + 1, 0.5), ReportOutcome::kNotReleased);
  EXPECT_EQ(graph.report(1, graph.precedence().first(0), 1), ReportOutcome::kNoSuchVisit);
  EXPECT_EQ(graph.report(1, 99, 1), ReportOutcome::kNoSuchVisit);
  EXPECT_EQ(graph.report(0, graph.precedence().first(0) + 1, 0.5), ReportOutcome::kTaken);
  EXPECT_EQ(graph.report(0, graph.precedence().first(0) + 1, 0.4), ReportOutcome::kBackwards);
  EXPECT_EQ(graph.report(0, graph.precedence().first(0), 0.9), ReportOutcome::kBackwards);
  EXPECT_FLOAT_EQ(graph.progress(0), 0.5F);
}

TEST(ExecutionGraph, PassesOverVisitsWhoseReportsWereLost) {
  ExecutionGraph graph = graphOf({{{1, 2, 3}, {0, 1, 2}}}, 4, 0.5);
  std::vector<VisitId> freed;
  EXPECT_EQ(graph.report(0, graph.precedence().last(0), 0.2, &freed), ReportOutcome::kTaken);
  EXPECT_EQ(freed, std::vector<VisitId>{graph.precedence().first(1) + 1});
  EXPECT_EQ(graph.report(1, graph.precedence().last(1), 1), ReportOutcome::kNotReleased);
  EXPECT_EQ(graph.at(1), graph.precedence().first(1)) << "a refused report changed something";
}

TEST(ExecutionGraph, ARingBeginsOnlyAsOne) {
  // Robot 3 has a step to make before it closes the ring.
  ExecutionGraph graph = graphOf({{{0, 0, 1}, {1, 1, 2}, {2, 2, 3}, {4, 3, 0}}}, 5, 0.5);
  ASSERT_EQ(graph.rings().size(), 1U);
  const VisitId event = graph.precedence().first(0) + 1;
  ASSERT_NE(graph.ringOf(event), nullptr);
  EXPECT_FALSE(graph.isReleased(event));
  EXPECT_EQ(graph.report(3, graph.precedence().first(3) + 1, 1), ReportOutcome::kTaken);
  for (const VisitId member : *graph.ringOf(event)) EXPECT_TRUE(graph.isReleased(member));
}

/// Where a robot is within its next move: standing, before its release, behind it.
class Interleavings {
 public:
  explicit Interleavings(const ExecutionGraph& start) : order_(start.precedence()) { visit(start); }
  std::size_t states() const { return seen_.size(); }

 private:
  using Key = std::vector<std::pair<VisitId, float>>;
  static constexpr double kBefore = 0.25;
  static constexpr double kBehind = 0.75;

  void visit(const ExecutionGraph& graph) {
    Key key;
    for (std::uint32_t i = 0; i < order_.robots(); ++i) {
      key.emplace_back(graph.at(i), graph.progress(i));
    }
    if (!seen_.insert(key).second) return;
    expectNobodyShares(graph);
    bool all_done = true;
    bool some_move = false;
    for (std::uint32_t robot = 0; robot < order_.robots(); ++robot) {
      if (graph.isDone(robot)) continue;
      all_done = false;
      const VisitId event = graph.at(robot) + 1;
      const double progress = graph.progress(robot);
      if (progress <= 0 && !graph.isReleased(event)) continue;
      some_move = true;
      const double next = progress <= 0 ? kBefore : (progress < 0.5 ? kBehind : 1);
      ExecutionGraph after = graph;
      const Ring* const ring = graph.ringOf(event);
      for (const VisitId member : ring != nullptr ? *ring : Ring{event}) {
        ASSERT_EQ(after.report(order_[member].robot, member, next), ReportOutcome::kTaken);
      }
      visit(after);
    }
    EXPECT_TRUE(all_done || some_move) << "a deadlock";
  }

  void expectNobodyShares(const ExecutionGraph& graph) const {
    std::map<Vertex, VisitId> held;  // by the event, where it moves
    for (std::uint32_t robot = 0; robot < order_.robots(); ++robot) {
      const VisitId at = graph.at(robot);
      const double progress = graph.progress(robot);
      std::vector<Vertex> holds;
      if (progress < 0.5) holds.push_back(order_[at].vertex);
      if (progress > 0) holds.push_back(order_[at + 1].vertex);
      for (const Vertex v : holds) {
        const auto [other, alone] = held.emplace(v, at + 1);
        if (alone) continue;
        const Ring* const ring = progress > 0 ? graph.ringOf(at + 1) : nullptr;
        EXPECT_TRUE(ring != nullptr && ring == graph.ringOf(other->second))
            << "two robots hold vertex " << v;
      }
    }
  }

  const Precedence& order_;
  std::set<Key> seen_;
};

/// Proof obligations (b), (c) and (e), on every order in which the events of tiny plans can happen.
TEST(ExecutionGraph, NoInterleavingCollidesOrStops) {
  std::size_t states = 0;
  std::size_t rings = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    const auto grid = test::gridFromAscii(seed % 2 == 0 ? std::vector<std::string>{"...", "..."}
                                                        : std::vector<std::string>{"..", ".."});
    const std::uint32_t robots = seed % 2 == 0 ? 3 : 4;
    const Plan plan = test::randomValidPlan(*grid, robots, 5, engine);
    const ExecutionGraph graph = graphOf(plan, grid->size(), 0.5);
    rings += graph.rings().size();
    states += Interleavings(graph).states();
  }
  EXPECT_GT(states, 1000U);
  EXPECT_GT(rings, 0U);
}

TEST(ExecutionForecast, IsTheEarliestScheduleWithoutReleaseAndTurns) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    RandomEngine engine(seed);
    const auto grid = test::gridFromAscii({"....", "..#.", "...."});
    const Plan plan = test::randomValidPlan(*grid, 8, 12, engine);
    const ExecutionGraph graph = graphOf(plan, grid->size(), 0);
    const Forecast all = forecast(graph, MotionTimes{});
    EXPECT_EQ(all.ends, earliestSteps(graph.precedence()));
  }
}

TEST(ExecutionForecast, CountsReleaseTurnsStartsAndStands) {
  const auto grid = test::gridFromAscii({"...", "..."});
  // Robot 0 goes east twice, then south; robot 1 follows it from the south.
  const auto at = [&](int x, int y) { return grid->vertexAt({x, y}); };
  const Plan plan = {{{at(0, 0), at(1, 0), at(2, 0), at(2, 1)}, {at(0, 1), at(0, 0), at(1, 0)}}};
  const ExecutionGraph graph = graphOf(plan, grid->size(), 0.5);
  const std::vector<std::uint8_t> turns = quarterTurns(*grid, graph.precedence());
  EXPECT_EQ(turns, (std::vector<std::uint8_t>{0, 0, 0, 1, 0, 0, 1}));
  const MotionTimes times{10, 4, 3};
  // Robot 0 starts from rest (13), goes on (23), turns, starts again (40). Robot 1 sets out when
  // robot 0 is half way (8), arrives after a start, turns and starts again.
  EXPECT_EQ(forecast(graph, times, turns).ends,
            (std::vector<std::uint32_t>{0, 13, 23, 40, 0, 21, 38}));
  EXPECT_EQ(forecast(graph, times, turns, {5, 0}).ends,
            (std::vector<std::uint32_t>{0, 18, 28, 45, 0, 26, 43}));
  EXPECT_EQ(sumOfArrivals(graph.precedence(), forecast(graph, times, turns)), 78U);
}

/// Plays events in an order that the graph allows, at random.
void playAtRandom(ExecutionGraph& graph, std::uint32_t count, RandomEngine& engine) {
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto robot = static_cast<std::uint32_t>(drawBelow(engine, graph.precedence().robots()));
    if (graph.isDone(robot)) continue;
    const VisitId event = graph.at(robot) + 1;
    const Ring* const ring = graph.ringOf(event);
    if (!graph.isReleased(event)) continue;
    const double fraction = drawBelow(engine, 2) == 0 ? 0.6 : 1;
    for (const VisitId member : ring != nullptr ? *ring : Ring{event}) {
      ASSERT_EQ(graph.report(graph.precedence()[member].robot, member, fraction),
                ReportOutcome::kTaken);
    }
  }
}

/// Proof obligation (d): another plan behind a downward-closed cut.
TEST(ExecutionCut, AnotherPlanBehindItIsExecutedToItsEnd) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    const auto grid = test::gridFromAscii({"....", "..#.", "...."});
    const Plan plan = test::randomValidPlan(*grid, 7, 14, engine);
    ExecutionGraph graph = graphOf(plan, grid->size(), 0.5);
    playAtRandom(graph, 20, engine);
    const Forecast soon = forecast(graph, MotionTimes{4});
    const Cut cut = cutBefore(graph, soon, 6);
    ASSERT_TRUE(isDownwardClosed(graph, cut));
    const Precedence rest = restBehind(graph, cut);
    const Plan before = planOf(rest, earliestSteps(rest));
    ASSERT_TRUE(validate(test::instanceOf(grid, before), before).empty());
    // The robots turn round and go anywhere else.
    Plan other = before;
    for (Path& path : other.paths) path = {path.front()};
    std::vector<Vertex> cells;
    for (const Path& path : other.paths) cells.push_back(path.front());
    other = test::randomWalkFrom(*grid, cells, 10, engine);
    ExecutionGraph joined = concatenate(graph, cut, other);
    for (std::uint32_t robot = 0; robot < 7; ++robot) {
      EXPECT_FLOAT_EQ(joined.progress(robot), graph.progress(robot));
      const Precedence& order = joined.precedence();
      EXPECT_EQ(order[order.last(robot)].vertex, other.paths[robot].back());
    }
    for (int round = 0; round < 200; ++round) playAtRandom(joined, 20, engine);
    for (std::uint32_t robot = 0; robot < 7; ++robot) EXPECT_TRUE(joined.isDone(robot));
  }
}

TEST(ExecutionCut, IsNotDownwardClosedWhereALeaderIsLeftOut) {
  const ExecutionGraph graph = graphOf({{{1, 2, 3}, {0, 1, 2}}}, 4, 0.5);
  EXPECT_TRUE(isDownwardClosed(graph, {0, 3}));
  EXPECT_TRUE(isDownwardClosed(graph, {1, 4}));
  EXPECT_FALSE(isDownwardClosed(graph, {0, 4}));
}

TEST(ExecutionCut, LeavesOutRingsAndWhatWaitsForThem) {
  // Robots 0 to 3 rotate; robot 4 follows robot 0, robot 5 has a way of its own.
  const Plan plan = {{{0, 1}, {1, 2}, {2, 3}, {3, 0, 5}, {6, 6, 0}, {7, 8}}};
  const ExecutionGraph graph = graphOf(plan, 9, 0.5);
  const Cut all = cutBefore(graph, forecast(graph, MotionTimes{10}), 1000);
  for (std::uint32_t robot = 0; robot < 6; ++robot) {
    EXPECT_EQ(all[robot], graph.precedence().last(robot));
  }
  const Cut cut = withoutRings(graph, all);
  EXPECT_TRUE(isDownwardClosed(graph, cut));
  for (std::uint32_t robot = 0; robot < 5; ++robot) {
    EXPECT_EQ(cut[robot], graph.precedence().first(robot));
  }
  EXPECT_EQ(cut[5], graph.precedence().last(5));
}

/// A plan of 1,000 robots and 400 steps that all move at every step: the most events there can be.
TEST(ExecutionGraph, AThousandRobotsAreBuiltInMilliseconds) {
  constexpr std::uint32_t kRobots = 1000;
  constexpr std::uint32_t kSteps = 400;
  Plan plan;
  for (std::uint32_t robot = 0; robot < kRobots; ++robot) {
    plan.paths.emplace_back();
    // Each on a row of its own, shifted, so that vertices lie apart in memory.
    for (std::uint32_t t = 0; t <= kSteps; ++t) plan.paths.back().push_back(robot * 8 + t % 8);
  }
  const std::clock_t begin = std::clock();  // of the processor: others may use it as well
  const ExecutionGraph graph = graphOf(plan, kRobots * 8, 0.5);
  const double took_ms = 1000.0 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  EXPECT_EQ(graph.precedence().size(), kRobots * (kSteps + 1));
  RecordProperty("build_ms", std::to_string(took_ms));
  EXPECT_LT(took_ms, test::kIsSanitized ? 1500 : 150) << "ten times what it takes on a slow core";
}

}  // namespace
}  // namespace split_mapf
