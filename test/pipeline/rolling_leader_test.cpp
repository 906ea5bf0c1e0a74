#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <queue>
#include <set>
#include <utility>
#include <vector>

#include "pipeline/rolling/admission.h"
#include "pipeline/rolling/leader_search.h"
#include "pipeline/rolling_scenes.h"
#include "split_mapf/core/random.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

using namespace test;

/// A crowd, one of which is to be led.
struct Crowd {
  GridPtr grid;
  std::vector<bool> occupied;  // by vertex
  Vertex leader = kNoVertex;
  Vertex goal = kNoVertex;
};

/// Whether the leader can come to its goal at all: every move of every robot is tried.
bool canCome(const Crowd& crowd) {
  const Graph& graph = crowd.grid->graph();
  using State = std::pair<Vertex, std::vector<bool>>;
  std::set<State> known = {{crowd.leader, crowd.occupied}};
  std::queue<State> open;
  open.emplace(crowd.leader, crowd.occupied);
  for (; !open.empty(); open.pop()) {
    if (open.front().first == crowd.goal) return true;
    for (Vertex v = 0; v < graph.size(); ++v) {
      if (!open.front().second[v]) continue;
      for (const Vertex u : graph.neighbours(v)) {
        if (open.front().second[u]) continue;
        State next = open.front();
        next.second[v] = false;
        next.second[u] = true;
        if (next.first == v) next.first = u;
        if (known.insert(next).second) open.push(std::move(next));
      }
    }
  }
  return false;
}

/// Carries the moves out one by one. @return whether each is one, and the leader is at its goal.
bool leads(const Crowd& crowd, const std::vector<rolling::LeaderMove>& moves) {
  std::vector<bool> occupied = crowd.occupied;
  Vertex leader = crowd.leader;
  for (const rolling::LeaderMove& move : moves) {
    if (!occupied[move.from] || occupied[move.to]) return false;
    if (!crowd.grid->isStep(crowd.grid->cellOf(move.from), crowd.grid->cellOf(move.to)))
      return false;
    occupied[move.from] = false;
    occupied[move.to] = true;
    if (leader == move.from) leader = move.to;
  }
  return leader == crowd.goal;
}

std::optional<std::vector<rolling::LeaderMove>> search(const Crowd& crowd) {
  const rolling::MoveGraph graph(*crowd.grid);
  rolling::SlopeCache slopes(graph, 1U << 20U);
  const auto slope = slopes.find(crowd.goal);
  if (!slope->reachable(crowd.leader)) return std::nullopt;
  const std::vector<bool> inside(graph.size(), true);
  rolling::LeaderQuestion question;
  question.graph = &graph;
  question.inside = &inside;
  question.occupied = &crowd.occupied;
  question.leader = crowd.leader;
  question.slope = slope.get();
  question.left = slope->distance(graph, crowd.leader, 1000);
  question.visits = 1000000;
  return rolling::LeaderSearch(question).find();
}

Crowd drawCrowd(std::uint64_t seed) {
  RandomEngine engine(seed);
  Crowd crowd;
  crowd.grid = generatedMap(5, 3, 0.1 + 0.1 * static_cast<double>(drawBelow(engine, 4)), seed);
  const auto cells = static_cast<std::uint32_t>(crowd.grid->size());
  crowd.occupied.assign(cells, false);
  const std::uint64_t robots = 1 + drawBelow(engine, cells - 1);
  for (std::uint64_t i = 0; i < robots; ++i) {
    crowd.leader = static_cast<Vertex>(drawBelow(engine, cells));
    crowd.occupied[crowd.leader] = true;
  }
  do {
    crowd.goal = static_cast<Vertex>(drawBelow(engine, cells));
  } while (crowd.goal == crowd.leader);
  return crowd;
}

TEST(LeaderSearch, FindsAWayWhereverThereIsOneAndNoOther) {
  int led = 0;
  int stays = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const Crowd crowd = drawCrowd(seed);
    const auto moves = search(crowd);
    ASSERT_EQ(moves.has_value(), canCome(crowd)) << "seed " << seed;
    if (moves) {
      ASSERT_TRUE(leads(crowd, *moves)) << "seed " << seed;
    }
    (moves ? led : stays) += 1;
  }
  EXPECT_GT(led, 30);
  EXPECT_GT(stays, 10);
}

TEST(LeaderSearch, BacksOffWhereAFullRoomHasToLetRobotsOut) {
  Crowd crowd;
  crowd.grid = gridFromAscii({"........", "###.####"});
  crowd.occupied.assign(crowd.grid->size(), false);
  for (int x = 4; x < 8; ++x) crowd.occupied[crowd.grid->vertexAt({x, 0})] = true;
  crowd.leader = crowd.grid->vertexAt({4, 0});
  crowd.goal = crowd.grid->vertexAt({7, 0});
  const auto moves = search(crowd);
  ASSERT_TRUE(moves.has_value());
  EXPECT_TRUE(leads(crowd, *moves));
}

TEST(Admission, LetsFewerGoInAJamAndSlowlyMoreBehindIt) {
  rolling::Admission admission;
  admission.note(100, 10, 0, 10);
  EXPECT_GE(admission.limit(), 100U) << "a few are stuck";
  admission.note(100, 11, 1, 10);
  EXPECT_EQ(admission.limit(), 50U);
  admission.note(100, 60, 30, 10);
  EXPECT_EQ(admission.limit(), 50U) << "too early to tell";
  for (std::uint64_t step = 41; step < 400; ++step) admission.note(100, 60, step, 10);
  EXPECT_EQ(admission.limit(), 10U) << "some always go";
  admission.note(100, 0, 500, 10);
  EXPECT_EQ(admission.limit(), 16U);
  for (std::uint64_t step = 501; step < 3000; ++step) admission.note(100, 0, step, 10);
  EXPECT_GE(admission.limit(), 100U);
}

/// A hall, and a corridor beside it in which two robots want to change places, and cannot.
RollTask hallBesideACorridor(const Grid& grid) {
  RollTask task;
  task.starts = {grid.vertexAt({0, 4}), grid.vertexAt({2, 4})};
  task.goals = {{task.starts[1]}, {task.starts[0]}};
  RandomEngine engine(1);
  constexpr std::uint32_t kHall = 12;  // its vertices are the first
  for (const Vertex start : {0U, 1U, 2U, 3U, 4U, 5U}) {
    task.starts.push_back(start);
    std::vector<Vertex>& goals = task.goals.emplace_back();
    for (Vertex last = start; goals.size() < 500; last = goals.back()) {
      const auto next = static_cast<Vertex>(drawBelow(engine, kHall - 1));
      goals.push_back(next < last ? next : next + 1);
    }
  }
  return task;
}

TEST(Rolling, RobotsThatCanNeverArriveDoNotMakeTheOthersRest) {
  const GridPtr grid = gridFromAscii({"....", "....", "....", "####", "...#"});
  RollOptions options;
  options.steps = 600;
  options.warmup = 300;
  options.rolling.window = 13;
  options.step_expansions = 500;
  const RollReport report = roll(grid, hallBesideACorridor(*grid), options);
  EXPECT_GT(report.throughput, 1);
}

TEST(Rolling, AJamInACrowdIsUndoneLikewiseAtAnyNumberOfThreads) {
  const GridPtr grid = generatedMap(14, 14, 0.2, 8);
  RollOptions options;
  options.steps = 1000;
  options.warmup = 400;
  options.rolling.window = 13;
  options.step_expansions = 1000;
  const RollTask task = randomGoals(*grid, grid->size() / 2, 8);
  const RollReport report = roll(grid, task, options);
  EXPECT_GT(report.throughput, 0.6);
  EXPECT_LT(report.longest_wait, 10 * report.service_mean);
  EXPECT_GT(report.escorts, 0U);
  EXPECT_GT(report.resting, 0);
  options.rolling.threads = 2;
  EXPECT_EQ(roll(grid, task, options).paths, report.paths);
}

}  // namespace
}  // namespace split_mapf
