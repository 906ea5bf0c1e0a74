#include "split_mapf/pipeline/rest_replanner.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/standing_times.h"
#include "search/departures.h"
#include "search/neighbourhood_search.h"
#include "search/replan_singly.h"
#include "split_mapf/core/validate.h"
#include "support/ascii_grid.h"
#include "support/random_plan.h"

namespace split_mapf {
namespace {

TEST(StandingTimes, ExpectWhatWasLeftOfDelaysThatLastedLonger) {
  StandingTimes times(3);
  EXPECT_EQ(times.expected(0), 0U);
  times.observe(0, true);
  times.observe(0, true);
  EXPECT_EQ(times.expected(0), 2U) << "none seen yet: as long again";
  for (int t = 0; t < 8; ++t) times.observe(0, true);
  times.observe(0, false);  // ten steps
  EXPECT_EQ(times.expected(0), 0U);
  times.observe(1, true);
  EXPECT_EQ(times.expected(1), 10U);
  times.observe(1, true);
  times.observe(1, true);
  EXPECT_EQ(times.expected(1), 8U);
  for (int t = 0; t < 20; ++t) times.observe(1, true);
  EXPECT_EQ(times.expected(1), 1U) << "longer than any seen";
}

/// Whoever has to stand stands, whatever is searched for, and the plan gets no worse.
TEST(Departures, AreKeptByEverySearch) {
  std::uint64_t gained = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    const auto grid = test::gridFromAscii({"......", ".#..#.", "......", "..#...", "......"});
    const Plan walk = test::randomValidPlan(*grid, 10, 15, engine);
    const Instance instance = test::instanceOf(grid, walk);
    std::vector<std::uint32_t> steps(10, 0);
    for (std::uint32_t& step : steps) {
      if (drawBelow(engine, 3) == 0) step = static_cast<std::uint32_t>(drawBelow(engine, 12));
    }
    const Precedence order(walk, grid->size());
    Plan plan = planOf(order, earliestSteps(order, steps));
    trimToArrival(plan);
    const Departures departures(steps);
    const auto expect_kept = [&](const Plan& after, const char* who) {
      SCOPED_TRACE(who);
      ASSERT_TRUE(validate(instance, after).empty());
      for (std::uint32_t i = 0; i < 10; ++i) {
        for (std::uint32_t t = 0; t <= steps[i]; ++t) {
          ASSERT_EQ(positionAt(after.paths[i], t), instance.start(i)) << "robot " << i;
        }
      }
      ASSERT_LE(sumOfCostsOf(after), sumOfCostsOf(plan));
    };
    ReplanEffort effort;
    effort.passes = 3;
    effort.departures = departures;
    expect_kept(replanSingly(instance, plan, effort, {}), "replanSingly");
    NeighbourhoodSearch search(instance, plan, kForever - 1, seed, departures);
    for (int i = 0; i < 150; ++i) {
      search.tryOne({}, [](const std::vector<PathChange>&) { return true; });
    }
    expect_kept(search.plan(), "NeighbourhoodSearch");
    gained += sumOfCostsOf(plan) - sumOfCostsOf(search.plan());
  }
  EXPECT_GT(gained, 1000U);
}

/// Replans at random moments of an execution: what is promised stays, what comes is cheaper by its
/// own forecast, robots are where they were, and all arrive.
TEST(RestReplanner, KeepsWhatIsPromisedAndIsCheaper) {
  std::size_t taken = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    const auto grid = test::gridFromAscii({"......", ".#..#.", "......", "..#..."});
    const Plan plan = test::randomValidPlan(*grid, 9, 15, engine);
    const Instance instance = test::instanceOf(grid, plan);
    ExecutionGraph graph(Precedence(plan, grid->size()), seed % 2 == 0 ? 0 : 0.5);
    const MotionTimes times{10, seed % 3 == 0 ? 5U : 0U, 0};
    for (int i = 0; i < 15; ++i) {
      const auto robot = static_cast<std::uint32_t>(drawBelow(engine, 9));
      if (graph.isDone(robot) || graph.ringOf(graph.at(robot) + 1) != nullptr) continue;
      graph.report(robot, graph.at(robot) + 1, drawBelow(engine, 2) == 0 ? 0.6 : 1);
    }
    ReplanQuestion question;
    question.graph = &graph;
    question.stands.assign(9, 0);
    question.stands[drawBelow(engine, 9)] = 70;
    question.came_from.assign(9, kNoVertex);
    question.commit = 10;
    question.avoid_rings = seed % 4 == 1;
    RestReplanner replanner(instance, times, {3000, seed});
    const ReplanAnswer answer = replanner.replan(question);
    if (!answer.execution) continue;
    ++taken;
    if (question.avoid_rings && graph.release() > 0 && graph.rings().empty()) {
      EXPECT_TRUE(answer.execution->rings().empty()) << "no ring is made";
    }
    const Precedence& order = answer.execution->precedence();
    for (std::uint32_t robot = 0; robot < 9; ++robot) {
      EXPECT_EQ(order[order.first(robot)].vertex, graph.precedence()[graph.at(robot)].vertex);
      EXPECT_FLOAT_EQ(answer.execution->progress(robot), graph.progress(robot));
      EXPECT_EQ(order[order.last(robot)].vertex, instance.goal(robot));
      if (graph.progress(robot) <= 0) continue;
      EXPECT_EQ(order[order.first(robot) + 1].vertex,
                graph.precedence()[graph.at(robot) + 1].vertex);
    }
    if (!question.avoid_rings) {
      EXPECT_LT(answer.cost_after, answer.cost_before);
    }
    EXPECT_EQ(answer.cost_after,
              sumOfArrivals(order,
                            forecast(*answer.execution, times,
                                     times.turn > 0 ? quarterTurns(*grid, order, question.came_from)
                                                    : std::vector<std::uint8_t>{},
                                     question.stands)));
    // The same question has the same answer.
    const ReplanAnswer again = RestReplanner(instance, times, {3000, seed}).replan(question);
    ASSERT_TRUE(again.execution);
    EXPECT_EQ(again.cost_after, answer.cost_after);
  }
  EXPECT_GT(taken, 50U);
}

/// Random walks of a crowd, with rotations, that nobody has begun.
struct RotatingCrowd {
  std::shared_ptr<const Grid> grid =
      std::make_shared<const Grid>(20, 20, std::vector<bool>(400, true));
  Plan plan;
  explicit RotatingCrowd(std::uint64_t seed) {
    RandomEngine engine(seed);
    plan = test::randomValidPlan(*grid, 280, 40, engine);
  }
  ReplanAnswer replan(std::uint64_t expansions) const {
    const Instance instance = test::instanceOf(grid, plan);
    const ExecutionGraph graph(Precedence(plan, grid->size()), 0.7);
    ReplanQuestion question;
    question.graph = &graph;
    question.commit = 10;
    question.avoid_rings = true;
    return RestReplanner(instance, {10, 0, 0}, {expansions, 0}).replan(question);
  }
};

/// What is done with each of its visits used to cost all of the budget.
TEST(RestReplanner, ImprovesALongRestToo) {
  const auto grid = std::make_shared<const Grid>(8, 8, std::vector<bool>(64, true));
  Plan plan;
  for (const Vertex from : {0U, 16U}) {
    Path path;
    for (std::uint32_t lap = 0; lap < 500; ++lap) path.insert(path.end(), {from, from + 1});
    plan.paths.push_back(std::move(path));
  }
  const Instance instance = test::instanceOf(grid, plan);
  const ExecutionGraph graph(Precedence(plan, grid->size()), 0);
  ReplanQuestion question;
  question.graph = &graph;
  question.commit = 10;
  // Two and a half states for each of 2,000 visits are more.
  const ReplanAnswer answer = RestReplanner(instance, {10, 0, 0}, {4600, 0}).replan(question);
  EXPECT_GT(answer.expansions, 0U);
  ASSERT_TRUE(answer.execution);
  EXPECT_LT(answer.cost_after, answer.cost_before / 4);
}

/// Paths that are taken out of the table and put back cost time, too, however few states are
/// expanded for them.
TEST(RestReplanner, PaysForWhatItDoesBesideSearching) {
  const RotatingCrowd crowd(2);
  const Precedence order(crowd.plan, crowd.grid->size());
  // Two and a half states a visit are half of it, and an expansion takes two states here.
  const std::uint64_t budget = std::uint64_t{5} * order.size();
  const ReplanAnswer answer = crowd.replan(budget);
  EXPECT_GT(answer.expansions, 0U);
  EXPECT_LT(answer.expansions, budget / 3);
  EXPECT_GT(answer.states, budget * 9 / 10);
}

TEST(RestReplanner, SpendsNoMoreThanItsBudgetOnRingsEither) {
  const RotatingCrowd crowd(1);
  ASSERT_GT(findRings(Precedence(crowd.plan, crowd.grid->size())).size(), 4U);
  // What is begun is ended: the searches around one ring, those of a batch.
  for (const std::uint64_t budget : {300U, 3000U, 100000U}) {
    const ReplanAnswer answer = crowd.replan(budget);
    EXPECT_GT(answer.states, budget / 2);
    EXPECT_LE(answer.states, budget + 1000) << budget;
  }
}

/// A robot that is to cross a corridor before a train of others comes.
struct CrossingBeforeATrain {
  static constexpr std::uint32_t kTrain = 14;
  static constexpr int kLength = 200;
  static constexpr int kCrossing = 20;
  static constexpr std::uint32_t kMove = 10;

  std::shared_ptr<const Grid> grid;
  Plan plan;
  CrossingBeforeATrain() {
    std::string beside(kLength, '#');
    beside[kCrossing] = '.';
    grid = test::gridFromAscii({beside, std::string(kLength, '.'), beside});
    for (std::uint32_t robot = 0; robot < kTrain; ++robot) {
      Path path;
      const int first = static_cast<int>(robot) + 3;
      for (int x = first; x < kLength - static_cast<int>(kTrain - robot); ++x) {
        path.push_back(grid->vertexAt({x, 1}));
      }
      plan.paths.push_back(std::move(path));
    }
    Path crossing;
    for (const int y : {0, 1, 2}) crossing.push_back(grid->vertexAt({kCrossing, y}));
    plan.paths.push_back(std::move(crossing));
  }
};

/// Its orders would hold all of them up, and there is little time to search for each.
TEST(RestReplanner, HasRobotsGoOnAsTheyWereMeantToWhenAnotherIsLate) {
  using Crossing = CrossingBeforeATrain;
  const Crossing crossing;
  const Instance instance = test::instanceOf(crossing.grid, crossing.plan);
  const MotionTimes times{Crossing::kMove, 0, 0};
  const ReplanBudget budget = {4000, 0};
  ExecutionGraph graph(Precedence(crossing.plan, crossing.grid->size()), 0);
  ReplanQuestion question;
  question.graph = &graph;
  question.stands.assign(Crossing::kTrain + 1, 0);
  question.commit = Crossing::kMove;
  RestReplanner replanner(instance, times, budget);
  const ReplanAnswer meant = replanner.replan(question);
  ASSERT_FALSE(meant.execution) << "nothing is better";
  // A move later all are where they were meant to be but the one that crosses.
  for (std::uint32_t robot = Crossing::kTrain; robot-- > 0;) {
    graph.report(robot, graph.at(robot) + 1, 1);
  }
  question.asked = Crossing::kMove;
  question.stands.back() = 50 * Crossing::kMove;
  const ReplanAnswer answer = replanner.replan(question);
  ASSERT_TRUE(answer.execution);
  // 52 moves for the one, of which two were planned, and a move has gone by for each of the others.
  EXPECT_EQ(answer.cost_after,
            meant.cost_before + (50 - std::uint64_t{Crossing::kTrain}) * Crossing::kMove);
  EXPECT_LE(answer.expansions, budget.expansions);
  // Who does not know of the schedule does not get so far.
  const ReplanAnswer anew = RestReplanner(instance, times, budget).replan(question);
  EXPECT_GT(anew.cost_after, answer.cost_after + 500);
}

}  // namespace
}  // namespace split_mapf
