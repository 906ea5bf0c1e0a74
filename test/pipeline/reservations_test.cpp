// Plans that keep clear of reserved paths, held to a brute-force search.
#include "split_mapf/core/reservations.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/core/random.h"
#include "split_mapf/improve/refine.h"
#include "split_mapf/parallel/executor.h"
#include "split_mapf/solver/registry.h"
#include "support/ascii_grid.h"
#include "support/long_run.h"
#include "support/reserved_oracle.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

using test::instanceFromAscii;
using test::optimalCostAround;

constexpr Objective kBoth[] = {Objective::kMakespan, Objective::kSumOfCosts};

SolveResult solveAround(const std::string& name, const Instance& instance,
                        const Reservations& reserved, Objective objective, double w = 1) {
  SolverOptions options;
  options.objective = objective;
  options.suboptimality = w;
  // Searches for plans that there are not end here; what is small takes some thousands.
  options.expansion_limit = 300000;
  SolveRequest request(instance);
  request.reserved = &reserved;
  return builtinSolvers().create(name, options)->solve(request);
}

/// A robot that walks at random among others and then stays.
Path randomWalk(const Instance& instance, const std::vector<Path>& others, std::size_t steps,
                RandomEngine& engine) {
  Path path = {static_cast<Vertex>(drawBelow(engine, instance.graph().size()))};
  while (path.size() < steps) {
    const VertexRange ways = instance.graph().neighbours(path.back());
    const auto count = static_cast<std::uint64_t>(ways.end() - ways.begin());
    const std::uint64_t way = drawBelow(engine, count + 1);
    path.push_back(way == count ? path.back() : *(ways.begin() + static_cast<std::ptrdiff_t>(way)));
  }
  std::vector<Path> all = others;
  all.push_back(path);
  try {
    const Reservations fits(instance.sharedGrid(), all);
    return path;
  } catch (const InputError&) {
    return {};
  }
}

Reservations randomReservations(const Instance& instance, RandomEngine& engine) {
  std::vector<Path> paths;
  for (int i = 0; i < 2; ++i) {
    Path path = randomWalk(instance, paths, 1 + drawBelow(engine, 7), engine);
    if (!path.empty()) paths.push_back(std::move(path));
  }
  return Reservations(instance.sharedGrid(), paths);
}

void expectHonest(const Instance& instance, const Reservations& reserved, const SolveResult& result,
                  const std::optional<std::uint64_t>& optimum, Objective objective) {
  if (!optimum) {
    EXPECT_NE(result.termination, Termination::kSolved);
    return;
  }
  EXPECT_NE(result.termination, Termination::kUnsolvable) << result.message;
  EXPECT_LE(result.lower_bound, *optimum);
  if (!result.plan) return;
  EXPECT_EQ(findViolation(instance, *result.plan, reserved), "");
  EXPECT_GE(costOf(*result.plan, objective), *optimum);
  EXPECT_TRUE(!result.optimal || costOf(*result.plan, objective) == *optimum);
}

TEST(Reservations, AreKeptByEverySolverThatTakesThemAsABruteForceSearchFinds) {
  const std::uint64_t cases = test::draws(150, 2000);
  std::map<std::string, int> solved;
  int solvable = 0;
  for (std::uint64_t seed = 0; seed < cases; ++seed) {
    const Instance instance = test::smallInstance(seed);
    if (instance.robots() > 3) continue;
    RandomEngine engine(seed);
    const Reservations reserved = randomReservations(instance, engine);
    SCOPED_TRACE("seed " + std::to_string(seed) + test::describe(instance));
    for (const Objective objective : kBoth) {
      const auto optimum = optimalCostAround(instance, reserved, objective);
      solvable += optimum ? 1 : 0;
      for (const auto& [name, traits] : builtinSolvers().traits()) {
        if (!traits.takes_reserved) continue;
        const SolveResult result = solveAround(name, instance, reserved, objective);
        expectHonest(instance, reserved, result, optimum, objective);
        solved[name] += result.plan ? 1 : 0;
        if (traits.optimal_at_one && result.plan) {
          EXPECT_EQ(costOf(*result.plan, objective), *optimum) << name;
        }
      }
    }
    if (HasFailure()) return;
  }
  EXPECT_EQ(solved.size(), 3U);
  for (const auto& [name, count] : solved) {
    EXPECT_GT(count, solvable * 8 / 10) << name << " of " << solvable;
  }
}

TEST(Reservations, LetARobotWaitUntilTheOtherHasPassed) {
  // Upwards through the middle column, at steps 1 and 2 in the robot's way.
  const Instance instance = instanceFromAscii({"...", "a..", "..."}, {"...", "..a", "..."});
  const auto at = [&](int x, int y) { return instance.grid().vertexAt({x, y}); };
  const Reservations reserved(instance.sharedGrid(), {{at(1, 2), at(1, 1), at(1, 1), at(1, 0)}});
  for (const char* name : {"ecbs", "prioritized", "conflict_optimizer"}) {
    const SolveResult result = solveAround(name, instance, reserved, Objective::kMakespan);
    ASSERT_TRUE(result.plan) << name << result.message;
    EXPECT_EQ(makespanOf(*result.plan), 4U) << name;
    EXPECT_TRUE(result.optimal) << name << ": no path around the reserved one is shorter";
  }
}

TEST(Reservations, AGoalThatIsHeldForGoodIsNoGoal) {
  const Instance instance = instanceFromAscii({"a.."}, {"..a"});
  const Reservations reserved(instance.sharedGrid(), {Path{2}});
  const SolveResult result = solveAround("ecbs", instance, reserved, Objective::kMakespan);
  EXPECT_EQ(result.termination, Termination::kUnsolvable);
  EXPECT_EQ(result.message, "reserved path 0 ends at the goal (2, 0) of robot 0");
}

TEST(Reservations, ARobotThatIsWalledInForGoodIsNamed) {
  const Instance instance = instanceFromAscii({"a..b"}, {"..ab"});
  const Reservations reserved(instance.sharedGrid(), {Path{1}});
  for (const char* name : {"ecbs", "prioritized", "conflict_optimizer"}) {
    const SolveResult result = solveAround(name, instance, reserved, Objective::kMakespan);
    EXPECT_EQ(result.termination, Termination::kUnsolvable);
    EXPECT_EQ(result.message, "robot 0 cannot reach its goal around the reserved paths") << name;
  }
}

TEST(Reservations, ThatAreNoPathsAreRefused) {
  const Instance instance = instanceFromAscii({"a.."}, {"..a"});
  const auto fault = [&](std::vector<Path> paths) -> std::string {
    try {
      const Reservations reserved(instance.sharedGrid(), std::move(paths));
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(fault({{0}, {}}), "reserved path 1 is empty; a vertex a step is expected");
  EXPECT_EQ(fault({{7}}), "reserved path 0 leads to vertex 7, but the grid has 3 vertices");
  EXPECT_NE(fault({{0, 2}}).find("reserved paths"), std::string::npos);
  EXPECT_NE(fault({{0, 1}, {2, 1}}).find("reserved paths"), std::string::npos);
  EXPECT_EQ(fault({{0, 1}, {1, 2}}), "none");
}

TEST(Reservations, AreCountedFromALaterStep) {
  const Instance instance = instanceFromAscii({"a.."}, {"..a"});
  const Reservations reserved(instance.sharedGrid(), {{0, 0, 1}, {1, 2, 2, 2}});
  EXPECT_EQ(reserved.lastStep(), 2U);
  EXPECT_EQ(reserved.from(1).paths(), (std::vector<Path>{{0, 1}, {2}}));
  EXPECT_EQ(reserved.from(9).paths(), (std::vector<Path>{{1}, {2}}));
}

/// Robots of a larger map, the first of them planned before and reserved.
struct Crowd {
  Instance whole = test::generatedInstance(24, 0.1, 120);
  std::optional<Instance> rest;
  Reservations reserved;

  Crowd() {
    const Plan plan = *builtinSolvers().create("prioritized", {})->solve(whole, Deadline()).plan;
    const std::size_t held = 40;
    reserved = Reservations(whole.sharedGrid(), {plan.paths.begin(), plan.paths.begin() + held});
    rest = Instance::fromVertices(whole.sharedGrid(),
                                  {whole.starts().begin() + held, whole.starts().end()},
                                  {whole.goals().begin() + held, whole.goals().end()});
  }
};

TEST(Reservations, OfACrowdAreKeptAtAnyThreadCount) {
  const Crowd crowd;
  Executor executor(3);
  for (const char* name : {"conflict_optimizer", "prioritized"}) {
    SolveRequest request(*crowd.rest);
    request.reserved = &crowd.reserved;
    const auto solver = builtinSolvers().create(name, {});
    const SolveResult alone = solver->solve(request);
    ASSERT_TRUE(alone.plan) << name << alone.message;
    EXPECT_EQ(findViolation(*crowd.rest, *alone.plan, crowd.reserved), "");
    request.threads = executor.lend();
    EXPECT_EQ(solver->solve(request).plan->paths, alone.plan->paths) << name;
  }
}

TEST(Reservations, AreKeptWhileAPlanIsRefined) {
  const Crowd crowd;
  for (const Objective objective : kBoth) {
    SolverOptions sums;
    sums.objective = Objective::kSumOfCosts;
    sums.values = {{"slack", "40"}};
    SolveRequest request(*crowd.rest);
    request.reserved = &crowd.reserved;
    const Plan first = *builtinSolvers().create("conflict_optimizer", sums)->solve(request).plan;
    RefineOptions options;
    options.objective = objective;
    options.threads = 2;
    options.reserved = &crowd.reserved;
    Executor executor(2);
    const auto some = std::make_shared<StopFlag>();
    int better = 0;
    Plan refined = first;
    // Until one is found, however slow the machine, and then what a second finds.
    for (const Deadline& end : {Deadline(120, some), Deadline(1)}) {
      refined = refine(*crowd.rest, refined, options, executor, end, [&](const Plan& plan) {
        EXPECT_EQ(findViolation(*crowd.rest, plan, crowd.reserved), "");
        ++better;
        some->request();
      });
    }
    EXPECT_EQ(findViolation(*crowd.rest, refined, crowd.reserved), "");
    EXPECT_LE(costOf(refined, objective), costOf(first, objective));
    EXPECT_GT(better, 0) << "the first plan is loose";
  }
}

TEST(Reservations, AKnownPlanIsWhereConflictOptimisationBegins) {
  const Crowd crowd;
  SolveRequest request(*crowd.rest);
  request.reserved = &crowd.reserved;
  const Plan known = *builtinSolvers().create("prioritized", {})->solve(request).plan;
  request.known = &known;
  SolverOptions options;
  options.expansion_limit = 1;  // nothing can be placed anew
  const SolveResult kept = builtinSolvers().create("conflict_optimizer", options)->solve(request);
  ASSERT_TRUE(kept.plan);
  EXPECT_LE(makespanOf(*kept.plan), makespanOf(known));

  // At its own best plan nothing is left to be placed.
  options.expansion_limit = 0;
  const auto solver = builtinSolvers().create("conflict_optimizer", options);
  SolveRequest anew(*crowd.rest);
  anew.reserved = &crowd.reserved;
  const SolveResult best = solver->solve(anew);
  ASSERT_TRUE(best.optimal);
  EXPECT_GT(best.low_level_expansions, 0U);
  anew.known = &*best.plan;
  const SolveResult again = solver->solve(anew);
  EXPECT_EQ(again.low_level_expansions, 0U);
  EXPECT_EQ(again.plan->paths, best.plan->paths);

  Plan broken = known;
  broken.paths[0] = {crowd.rest->start(1)};
  request.known = &broken;
  EXPECT_THROW(builtinSolvers().create("conflict_optimizer", options)->solve(request), InputError);
}

}  // namespace
}  // namespace split_mapf
