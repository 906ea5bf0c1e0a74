// Searches for robots that must not come to a vertex in the step in which another leaves it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "search/departures.h"
#include "search/gap_search.h"
#include "search/neighbourhood_search.h"
#include "search/replan_singly.h"
#include "search/reservation_table.h"
#include "split_mapf/core/collision.h"
#include "split_mapf/core/precedence.h"
#include "split_mapf/core/random.h"
#include "split_mapf/core/validate.h"
#include "support/ascii_grid.h"
#include "support/placed_plan.h"
#include "support/random_plan.h"

namespace split_mapf {
namespace {

/// A case: robots on a small grid, some of which have to stand, and a plan that keeps the headway.
struct Case {
  std::shared_ptr<const Grid> grid;
  std::vector<std::uint32_t> steps;  // until which robots stand
  Plan plan;
};

std::optional<Case> drawCase(std::uint64_t seed, std::uint32_t robots, RandomEngine& engine) {
  Case drawn;
  drawn.grid = test::gridFromAscii({"......", ".#..#.", "......", "..#...", "......"});
  const Plan walk = test::randomValidPlan(*drawn.grid, robots, 15, engine);
  drawn.steps.assign(robots, 0);
  for (std::uint32_t& step : drawn.steps) {
    if (seed % 2 == 1 && drawBelow(engine, 3) == 0) {
      step = static_cast<std::uint32_t>(drawBelow(engine, 12));
    }
  }
  const Precedence order(walk, drawn.grid->size());
  if (!findRings(order).empty()) return std::nullopt;
  drawn.plan = planOf(order, earliestSteps(order, drawn.steps, {}, 1));
  trimToArrival(drawn.plan);
  return drawn;
}

void expectNobodyFollows(const Plan& plan) {
  for (std::size_t a = 0; a < plan.paths.size(); ++a) {
    for (std::size_t b = a + 1; b < plan.paths.size(); ++b) {
      ASSERT_EQ(firstFollowing(plan.paths[a], plan.paths[b]), std::nullopt) << a << " and " << b;
    }
  }
}

TEST(Headway, IsKeptByEverySearchThatImprovesAPlan) {
  std::uint64_t gained = 0;
  std::uint32_t cases = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    const std::optional<Case> drawn = drawCase(seed, 10, engine);
    if (!drawn) continue;
    ++cases;
    const Instance instance = test::instanceOf(drawn->grid, drawn->plan);
    const Departures departures(drawn->steps);
    const auto expect_kept = [&](const Plan& after) {
      ASSERT_TRUE(validate(instance, after).empty());
      expectNobodyFollows(after);
      for (std::uint32_t i = 0; i < after.paths.size(); ++i) {
        for (std::uint32_t t = 0; t <= drawn->steps[i]; ++t) {
          ASSERT_EQ(positionAt(after.paths[i], t), instance.start(i)) << "robot " << i;
        }
      }
      ASSERT_LE(sumOfCostsOf(after), sumOfCostsOf(drawn->plan));
    };
    expect_kept(drawn->plan);
    ReplanEffort effort;
    effort.passes = 3;
    effort.departures = departures;
    effort.headway = 1;
    expect_kept(replanSingly(instance, drawn->plan, effort, {}));
    NeighbourhoodSearch search(instance, drawn->plan, kForever - 1, seed, departures, nullptr, 1);
    for (int i = 0; i < 150; ++i) {
      search.tryOne({}, [&](const std::vector<PathChange>&) { return drawBelow(engine, 8) > 0; });
      if (i % 10 > 0) continue;
      expect_kept(search.plan());
      const std::uint32_t vertices = drawn->grid->size();
      test::expectSame(search.table(), ReservationTable(vertices, search.plan(), 1), vertices);
      if (HasFatalFailure()) return;
    }
    gained += sumOfCostsOf(drawn->plan) - sumOfCostsOf(search.plan());
  }
  EXPECT_GT(cases, 15U);
  EXPECT_GT(gained, 20 * cases);
}

TEST(Headway, IsKeptByATableThatOneSearchHandsToTheNext) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    const std::optional<Case> drawn = drawCase(seed, 10, engine);
    if (!drawn) continue;
    const std::uint32_t vertices = drawn->grid->size();
    const Instance instance = test::instanceOf(drawn->grid, drawn->plan);
    const Departures departures(drawn->steps);
    ReservationTable table(vertices, drawn->plan, 1);
    ReplanEffort effort;
    effort.passes = 3;
    effort.departures = departures;
    effort.headway = 1;
    const Plan alone = replanSingly(instance, drawn->plan, effort, {});
    effort.table = &table;
    const Plan better = replanSingly(instance, drawn->plan, effort, {});
    EXPECT_EQ(better.paths, alone.paths);
    test::expectSame(table, ReservationTable(vertices, better, 1), vertices);
    NeighbourhoodSearch own(instance, better, kForever - 1, seed, departures, nullptr, 1);
    NeighbourhoodSearch given(instance, std::move(table), better, kForever - 1, seed, departures);
    for (int i = 0; i < 50; ++i) {
      own.tryOne({}, [](const std::vector<PathChange>&) { return true; });
      given.tryOne({}, [](const std::vector<PathChange>&) { return true; });
    }
    ASSERT_EQ(given.plan().paths, own.plan().paths);
    test::expectSame(given.table(), ReservationTable(vertices, given.plan(), 1), vertices);
    if (HasFatalFailure()) return;
  }
}

/// By brute force: where the robot may be step by step.
std::optional<std::uint32_t> earliestArrival(const Instance& instance, const Plan& placed,
                                             std::uint32_t robot) {
  const std::uint32_t last = makespanOf(placed) + instance.graph().size();
  const auto is_free = [&](Vertex v, std::uint32_t t) {
    for (std::uint32_t other = 0; other < placed.paths.size(); ++other) {
      if (other == robot) continue;
      for (std::uint32_t step = t > 0 ? t - 1 : 0; step <= t + 1; ++step) {
        if (positionAt(placed.paths[other], step) == v) return false;
      }
    }
    return true;
  };
  std::vector<bool> at(instance.graph().size(), false);
  at[instance.start(robot)] = true;
  std::optional<std::uint32_t> since;  // at its goal all the time
  for (std::uint32_t t = 0; t <= last; ++t) {
    const Vertex goal = instance.goal(robot);
    if (t > 0) {
      std::vector<bool> next(at.size(), false);
      for (Vertex v = 0; v < at.size(); ++v) {
        if (!at[v]) continue;
        if (is_free(v, t)) next[v] = true;
        for (const Vertex to : instance.graph().neighbours(v)) {
          if (is_free(to, t)) next[to] = true;
        }
      }
      at = next;
    }
    if (at[goal] && !since) since = t;
    if (!is_free(goal, t)) since.reset();
  }
  return since;
}

TEST(Headway, GapSearchFindsTheEarliestArrival) {
  std::uint32_t later = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    const std::optional<Case> drawn = drawCase(0, 7, engine);
    if (!drawn) continue;
    const Instance instance = test::instanceOf(drawn->grid, drawn->plan);
    ReservationTable table(drawn->grid->size(), drawn->plan, 1);
    const auto robot = static_cast<std::uint32_t>(drawBelow(engine, 7));
    const Path& own = drawn->plan.paths[robot];
    table.removeTail(robot, own, 0);
    const HeldDistances distances = instance.distances(robot);
    table.toggleHeadway(own, 0);
    GapSearch search(drawn->grid->graph());
    Path path = search.search(queryFrom(own, 0, *distances, table, kForever - 1), Deadline()).path;
    table.toggleHeadway(own, 0);
    ASSERT_FALSE(path.empty());
    while (path.size() > 1 && path[path.size() - 2] == path.back()) path.pop_back();
    EXPECT_EQ(path.size() - 1, earliestArrival(instance, drawn->plan, robot));
    later += path.size() - 1 > instance.shortestLength(robot) ? 1 : 0;
    table.insertTail(robot, path, 0);
    Plan with = drawn->plan;
    with.paths[robot] = path;
    expectNobodyFollows(with);
    test::expectSame(table, ReservationTable(drawn->grid->size(), with, 1), drawn->grid->size());
  }
  EXPECT_GT(later, 20U);
}

}  // namespace
}  // namespace split_mapf
