#include "split_mapf/core/close_moves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>

#include "split_mapf/core/execution_cut.h"
#include "split_mapf/core/execution_forecast.h"
#include "split_mapf/core/execution_graph.h"
#include "split_mapf/core/random.h"

namespace split_mapf {
namespace {

std::map<MoveId, float> closeTo(const CloseMoves& moves, Vertex from, Vertex to) {
  std::map<MoveId, float> close;
  for (const CloseMoves::Close& one : moves.closeTo(moves.moveOf(from, to))) {
    close[one.move] = one.release;
  }
  return close;
}

TEST(CloseMoves, FollowersAndThoseThatLeaveTheSameVertexWaitForAPart) {
  // A corner at vertex 1 and a way straight on, edges of 1 m.
  const Graph graph(4, {{0, 1}, {1, 2}, {1, 3}});
  const CloseMoves moves(graph, {{0, 0}, {1, 0}, {2, 0}, {1, 1}}, 0.5);
  const auto followers = closeTo(moves, 0, 1);
  ASSERT_EQ(followers.size(), 2U) << "moves that end on the follower's way are not among them";
  EXPECT_NEAR(followers.at(moves.moveOf(1, 2)), 0.5, 1e-4);
  EXPECT_NEAR(followers.at(moves.moveOf(1, 3)), 0.5, 1e-4);
  const auto away = closeTo(moves, 1, 3);
  ASSERT_EQ(away.size(), 2U);
  EXPECT_NEAR(away.at(moves.moveOf(1, 2)), 0.5, 1e-4);
  EXPECT_EQ(closeTo(moves, 3, 1), away);
}

TEST(CloseMoves, EdgesWithoutACommonVertexExcludeEachOther) {
  // Two chevrons, tip to tip: the middles of the edges come as near as 0.4 m.
  const Graph graph(4, {{0, 1}, {2, 3}});
  const CloseMoves moves(graph, {{0, 0}, {2, 0}, {1, 0.4}, {1, 2}}, 0.3);
  EXPECT_TRUE(closeTo(moves, 0, 1).empty());
  // Vertex 2 is nearer than that to the edge from 0 to 1.
  EXPECT_THROW(CloseMoves(graph, {{0, 0}, {2, 0}, {1, 0.4}, {1, 2}}, 0.5), std::invalid_argument);
  const CloseMoves crossing(graph, {{0, 0}, {2, 0}, {1, -1}, {1, 1}}, 0.5);
  const auto close = closeTo(crossing, 0, 1);
  ASSERT_EQ(close.size(), 2U);
  EXPECT_NEAR(close.at(crossing.moveOf(2, 3)), 0.75, 1e-4);
  EXPECT_NEAR(close.at(crossing.moveOf(3, 2)), 0.75, 1e-4);
}

TEST(CloseMoves, SharpCornersNeedMoreOfTheMove) {
  // Vertices 0 and 2 lie 60 degrees apart as seen from 1.
  const double height = std::sqrt(3.0) / 2;
  const CloseMoves moves(Graph(3, {{0, 1}, {1, 2}}), {{0, 0}, {1, 0}, {0.5, height}}, 0.6);
  EXPECT_NEAR(closeTo(moves, 0, 1).at(moves.moveOf(1, 2)), 0.6 / height, 1e-4);
}

TEST(CloseMoves, ReleasesKeepTheDistanceAndNotMuchMore) {
  RandomEngine engine(5);
  const auto draw = [&] { return static_cast<double>(drawBelow(engine, 4001)) / 1000 - 2; };
  std::uint32_t parts = 0;
  for (int i = 0; i < 3000; ++i) {
    const PlanePoint from{draw(), draw()};
    const PlanePoint to{draw(), draw()};
    const PlanePoint a{draw(), draw()};
    const PlanePoint b{draw(), draw()};
    const double distance = 0.4;
    const double release = releaseFraction(from, to, a, b, distance);
    const auto gap = [&](double p) {
      const double x = from.x + p * (to.x - from.x);
      const double y = from.y + p * (to.y - from.y);
      double least = 1e9;
      for (int k = 0; k <= 1000; ++k) {
        const double q = k / 1000.0;
        least = std::min(least, std::hypot(x - a.x - q * (b.x - a.x), y - a.y - q * (b.y - a.y)));
      }
      return least;
    };
    if (release > 1) {
      EXPECT_LT(gap(1), distance + 1e-2);
      continue;
    }
    for (int k = 0; k <= 20; ++k) EXPECT_GE(gap(release + (1 - release) * k / 20), distance - 1e-5);
    if (release <= 0) continue;
    ++parts;
    EXPECT_LT(gap(0.99 * release), distance + 1e-2) << "released later than need be";
  }
  EXPECT_GT(parts, 100U);
}

TEST(CloseMoves, KnowsWhichVerticesARobotBesideTheGraphCloses) {
  const CloseMoves moves(Graph(4, {{0, 1}, {2, 3}}), {{0, 0}, {2, 0}, {0, 5}, {2, 5}}, 0.5);
  EXPECT_EQ(moves.nearTo({1, 0.4}, {1, 0.4}, 0.5), (std::vector<Vertex>{0, 1}));
  EXPECT_TRUE(moves.nearTo({1, 0.6}, {1, 0.6}, 0.5).empty());
  EXPECT_EQ(moves.nearTo({1, -1}, {1, 6}, 0.5).size(), 4U) << "its way crosses both";
}

/// Two robots that cross without a common vertex; a third one follows the first.
ExecutionGraph crossing(std::shared_ptr<const CloseMoves> moves) {
  return ExecutionGraph(Precedence({{{0, 1}, {2, 2, 3}, {4, 0}}}, 5), 0, std::move(moves));
}

std::shared_ptr<const CloseMoves> crossingMoves() {
  return std::make_shared<const CloseMoves>(
      Graph(5, {{0, 1}, {2, 3}, {0, 4}}),
      std::vector<PlanePoint>{{0, 0}, {2, 0}, {1, -1}, {1, 1}, {-1, 0}}, 0.5);
}

TEST(ExecutionOnAPlanningGraph, WaitsForCloseEdgesWithoutACommonVertex) {
  ExecutionGraph graph = crossing(crossingMoves());
  const VisitId first = graph.precedence().last(0);
  const VisitId second = graph.precedence().last(1);
  const VisitId third = graph.precedence().last(2);
  EXPECT_TRUE(graph.isReleased(first));
  EXPECT_FALSE(graph.isReleased(second)) << "it goes later by the plan";
  EXPECT_FALSE(graph.isReleased(third));
  ASSERT_EQ(graph.report(0, first, 0.3), ReportOutcome::kTaken);
  EXPECT_TRUE(graph.isReleased(third)) << "a quarter is enough for who goes straight on";
  EXPECT_FALSE(graph.isReleased(second));
  ASSERT_EQ(graph.report(0, first, 0.76), ReportOutcome::kTaken);
  EXPECT_TRUE(graph.isReleased(second));
  EXPECT_EQ(graph.report(1, second, 1), ReportOutcome::kTaken);
}

TEST(ExecutionOnAPlanningGraph, KeepsTheOrderOfAStepWhenOthersHaveLeft) {
  // In one step robot 0 follows robot 1, which follows robot 2; robots 0 and 2 come close. When
  // robot 1 is gone, robot 2 has still to go before robot 0.
  const Graph graph(8, {{0, 1}, {1, 2}, {2, 3}, {4, 5}});
  std::vector<CloseMoves::Pair> pairs;
  const std::vector<PlanePoint> places(8);
  const CloseMoves none(graph, places, pairs);
  const MoveId in = none.moveOf(0, 1);
  const MoveId out = none.moveOf(2, 3);
  pairs = {{in, out, 0.5F}, {out, in, 0.5F}};
  const auto moves = std::make_shared<const CloseMoves>(graph, places, pairs);
  const ExecutionGraph whole(Precedence({{{0, 1}, {1, 2}, {2, 3}}}, 8), 0, moves);
  const auto waits = [](const ExecutionGraph& one, VisitId event) {
    std::vector<VisitId> awaited;
    one.forEachAwaited(event, [&](VisitId other, double) { awaited.push_back(other); });
    return awaited;
  };
  EXPECT_EQ(waits(whole, 1), (std::vector<VisitId>{5}));
  EXPECT_TRUE(waits(whole, 5).empty());
  std::vector<Visit> left;
  for (const VisitId v : {0U, 1U, 4U, 5U}) {
    Visit visit = whole.precedence()[v];
    visit.robot = v < 2 ? 0 : 1;
    left.push_back(visit);
  }
  const ExecutionGraph rest(Precedence::fromVisits(left, 8), 0, moves);
  EXPECT_EQ(waits(rest, 1), (std::vector<VisitId>{3}));
  EXPECT_TRUE(waits(rest, 3).empty());
}

TEST(ExecutionOnAPlanningGraph, ForecastsAndCutsKnowOfCloseEdges) {
  const ExecutionGraph graph = crossing(crossingMoves());
  const Precedence& order = graph.precedence();
  const Forecast all = forecast(graph, MotionTimes{100});
  EXPECT_EQ(all.begins[order.last(0)], 0U);
  // Fractions are rounded up, and to whole ticks.
  EXPECT_NEAR(all.begins[order.last(1)], 75, 1);
  EXPECT_NEAR(all.begins[order.last(2)], 25, 1);
  EXPECT_FALSE(isDownwardClosed(graph, {order.first(0), order.last(1), order.first(2)}));
  EXPECT_TRUE(isDownwardClosed(graph, {order.last(0), order.last(1), order.first(2)}));
  const Cut cut = cutBefore(graph, all, 50);
  EXPECT_EQ(cut, (Cut{order.last(0), order.first(1), order.last(2)}));
  EXPECT_TRUE(isDownwardClosed(graph, cut));
}

}  // namespace
}  // namespace split_mapf
