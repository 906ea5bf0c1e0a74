// What every registered solver has to keep, whatever its method: one suite over all of them.
#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "solver/available/available_solvers.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/validate.h"
#include "support/ascii_grid.h"
#include "support/long_run.h"
#include "support/oracle_cases.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

using test::instanceFromAscii;
using test::OracleCase;
using test::oracleCases;

// Far more than a small instance takes: a solver that reaches it hangs.
constexpr double kPatienceSec = 60;
// For instances that a solver may well not solve.
constexpr double kKnotSec = 0.2;

double secondsSince(Deadline::Clock::time_point begin) {
  return std::chrono::duration<double>(Deadline::Clock::now() - begin).count();
}

/// Parameters: name of the solver, objective.
class SolverConformance : public ::testing::TestWithParam<std::tuple<std::string, Objective>> {
 protected:
  Objective objective() const { return std::get<1>(GetParam()); }

  std::unique_ptr<Solver> makeSolver(double suboptimality = 1.5, std::uint64_t seed = 0) const {
    SolverOptions options;
    options.objective = objective();
    options.suboptimality = suboptimality;
    options.seed = seed;
    return availableSolvers().create(std::get<0>(GetParam()), options);
  }

  /// What holds for every answer to an instance whose optimum is known.
  void expectHonest(const Instance& instance, const SolveResult& result,
                    std::optional<std::uint64_t> optimum) const {
    EXPECT_EQ(result.plan.has_value(), result.termination == Termination::kSolved);
    EXPECT_EQ(result.certified_by.empty(), !result.optimal);
    if (optimum) {
      EXPECT_NE(result.termination, Termination::kUnsolvable);
      EXPECT_LE(result.lower_bound, *optimum);
    } else {
      EXPECT_NE(result.termination, Termination::kSolved);
    }
    if (result.termination == Termination::kUnsolvable ||
        result.termination == Termination::kNoPlanFound) {
      EXPECT_NE(result.message, "") << "a failure needs a reason";
    }
    if (!result.plan || !optimum) return;
    for (const Violation& violation : validate(instance, *result.plan)) {
      ADD_FAILURE() << violation.message;
    }
    const std::uint64_t cost = costOf(*result.plan, objective());
    EXPECT_GE(cost, *optimum);
    if (result.optimal) {
      EXPECT_EQ(cost, *optimum);
    }
    for (const Path& path : result.plan->paths) {
      EXPECT_EQ(path.size(), costOf(path) + 1) << "a path ends at its arrival";
    }
  }

  void expectCost(const Instance& instance, std::uint64_t optimum) const {
    const SolveResult result = makeSolver(1)->solve(instance, Deadline(kPatienceSec));
    expectHonest(instance, result, optimum);
    if (!traits().complete && result.termination == Termination::kNoPlanFound) return;
    ASSERT_EQ(result.termination, Termination::kSolved);
    if (!traits().optimal_at_one) return;
    EXPECT_EQ(costOf(*result.plan, objective()), optimum);
    EXPECT_TRUE(result.optimal);
  }

  const SolverTraits& traits() const {
    return availableSolvers().info(std::get<0>(GetParam())).traits;
  }
  /// Expects that the request is refused by the solver's name, or is taken.
  void expectTaken(bool taken, const SolveRequest& request) const {
    try {
      const SolveResult result = makeSolver()->solve(request);
      EXPECT_TRUE(taken);
      EXPECT_EQ(result.termination, Termination::kSolved) << result.message;
    } catch (const OptionError& error) {
      EXPECT_FALSE(taken) << error.what();
      EXPECT_NE(std::string(error.what()).find("'" + std::get<0>(GetParam()) + "'"),
                std::string::npos);
    }
  }
};

TEST_P(SolverConformance, IsHonestOnSolvableInstances) {
  int solved = 0;
  for (const OracleCase& c : oracleCases()) {
    if (!c.optimum(objective())) continue;
    SCOPED_TRACE("seed " + std::to_string(c.seed) + test::describe(c.instance));
    const SolveResult result =
        makeSolver()->solve(c.instance, Deadline(c.isKnot() ? kKnotSec : kPatienceSec));
    expectHonest(c.instance, result, c.optimum(objective()));
    if (!c.isKnot()) {
      EXPECT_NE(result.termination, Termination::kTimeout);
    }
    solved += result.termination == Termination::kSolved ? 1 : 0;
    if (HasFailure()) return;
  }
  EXPECT_GT(solved, test::draws(200)) << "a suite that nothing is solved in shows little";
}

TEST_P(SolverConformance, BearsTheNameAndTheTraitsItIsRegisteredWith) {
  const auto solver = makeSolver();
  EXPECT_EQ(solver->name(), std::get<0>(GetParam()));
  const auto texts = [](const SolverTraits& t) {
    return std::make_tuple(t.complete, t.optimal_at_one, t.makespan, t.sum_of_costs, t.loose_plans,
                           t.anytime, t.takes_known, t.takes_reserved, t.uses_threads,
                           t.fallback_rank, t.small_groups_only, t.keeps_step_table,
                           t.two_thread_gain, t.small_knot_expansions);
  };
  EXPECT_EQ(texts(solver->traits()), texts(traits()));
}

TEST_P(SolverConformance, RefusesByNameWhatItDoesNotTake) {
  const Instance instance = instanceFromAscii({"a..", "b.."}, {"..a", "..b"});
  const Plan known = *makeSolver()->solve(instance, Deadline(kPatienceSec)).plan;
  SolveRequest request(instance, Deadline(kPatienceSec));
  request.known = &known;
  expectTaken(traits().takes_known, request);
  request.known = nullptr;
  const Reservations none;
  request.reserved = &none;
  expectTaken(true, request);
  const Instance tall = instanceFromAscii({"a..", "b..", "..."}, {"..a", "..b", "..."});
  const Reservations reserved(tall.sharedGrid(), {Path(4, tall.grid().vertexAt({1, 2}))});
  SolveRequest around(tall, Deadline(kPatienceSec));
  around.reserved = &reserved;
  expectTaken(traits().takes_reserved, around);
  SolveRequest listening(instance, Deadline(kPatienceSec));
  listening.on_better = [&](const Plan& plan) { EXPECT_TRUE(validate(instance, plan).empty()); };
  expectTaken(traits().anytime, listening);
}

TEST_P(SolverConformance, IsHonestOnUnsolvableInstances) {
  int unsolvable = 0;
  for (const OracleCase& c : oracleCases()) {
    if (c.optimum(objective())) continue;
    SCOPED_TRACE("seed " + std::to_string(c.seed) + test::describe(c.instance));
    expectHonest(c.instance, makeSolver()->solve(c.instance, Deadline(0.02)), std::nullopt);
    if (HasFailure()) return;
    ++unsolvable;
  }
  EXPECT_GT(unsolvable, test::draws(20));
}

TEST_P(SolverConformance, ProvesACutOffRobotAndNamesIt) {
  const SolveResult result =
      makeSolver()->solve(instanceFromAscii({"ab.#."}, {"a..#b"}), Deadline(kPatienceSec));
  EXPECT_EQ(result.termination, Termination::kUnsolvable);
  EXPECT_NE(result.message.find("robot 1"), std::string::npos) << result.message;
}

TEST_P(SolverConformance, RobotsAtHomeCostNothing) {
  const Instance instance = instanceFromAscii({"ab", "c."}, {"ab", "c."});
  const SolveResult result = makeSolver()->solve(instance, Deadline(kPatienceSec));
  ASSERT_EQ(result.termination, Termination::kSolved);
  EXPECT_EQ(costOf(*result.plan, objective()), 0U);
  expectHonest(instance, result, 0);
}

TEST_P(SolverConformance, KnowsThatFullRotationsAreLegal) {
  expectCost(instanceFromAscii({"ab", "dc"}, {"da", "cb"}),
             objective() == Objective::kMakespan ? 1 : 4);
}

TEST_P(SolverConformance, KnowsThatFollowingIsLegal) {
  expectCost(instanceFromAscii({"abc."}, {".abc"}), objective() == Objective::kMakespan ? 1 : 3);
}

TEST_P(SolverConformance, PassesInACorridorWithASiding) {
  expectCost(instanceFromAscii({"a.b",  //
                                "#.#"},
                               {"b.a",  //
                                "#.#"}),
             objective() == Objective::kMakespan ? 4 : 7);
}

TEST_P(SolverConformance, NeverSwapsInACorridorWithoutOne) {
  const Instance instance = instanceFromAscii({"a..b"}, {"b..a"});
  expectHonest(instance, makeSolver()->solve(instance, Deadline(0.2)), std::nullopt);
}

TEST_P(SolverConformance, AnswersTimeoutWhenThereIsNoTimeLeft) {
  const SolveResult result = makeSolver()->solve(test::generatedInstance(24, 0.1, 60), Deadline(0));
  EXPECT_EQ(result.termination, Termination::kTimeout);
  EXPECT_FALSE(result.plan);
}

TEST_P(SolverConformance, AnswersCancelledWhenTheFlagIsUpAlready) {
  auto stop = std::make_shared<StopFlag>();
  stop->request();
  const auto begin = Deadline::Clock::now();
  const SolveResult result =
      makeSolver()->solve(test::generatedInstance(24, 0.1, 60), Deadline(kPatienceSec, stop));
  EXPECT_EQ(result.termination, Termination::kCancelled);
  EXPECT_FALSE(result.plan);
  EXPECT_LT(secondsSince(begin), 1);
}

TEST_P(SolverConformance, StopsSoonWhenTheFlagIsRaisedDuringTheSearch) {
  auto stop = std::make_shared<StopFlag>();
  const Instance instance = test::generatedInstance(24, 0.2, 260);
  auto answer = std::async(std::launch::async, [&] {
    return makeSolver(1)->solve(instance, Deadline(kPatienceSec, stop));
  });
  const bool done = answer.wait_for(std::chrono::milliseconds(300)) == std::future_status::ready;
  const auto raised = Deadline::Clock::now();
  stop->request();
  const SolveResult result = answer.get();
  EXPECT_LT(secondsSince(raised), 1);
  if (done) return;
  EXPECT_TRUE(result.termination == Termination::kCancelled ||
              result.termination == Termination::kSolved)
      << toString(result.termination);
}

TEST_P(SolverConformance, TheSameSeedGivesTheSamePlanAlsoToConcurrentCallers) {
  const Instance instance = test::generatedInstance(24, 0.1, 40);
  const auto solver = makeSolver(1.5, 11);
  const SolveResult first = solver->solve(instance, Deadline(kPatienceSec));
  ASSERT_EQ(first.termination, Termination::kSolved);
  EXPECT_TRUE(validate(instance, *first.plan).empty());
  std::vector<std::future<SolveResult>> others;
  others.reserve(3);
  for (int i = 0; i < 3; ++i) {
    others.push_back(std::async(std::launch::async,
                                [&] { return solver->solve(instance, Deadline(kPatienceSec)); }));
  }
  for (auto& other : others) EXPECT_EQ(other.get().plan->paths, first.plan->paths);
  const SolveResult fresh = makeSolver(1.5, 11)->solve(instance, Deadline(kPatienceSec));
  EXPECT_EQ(fresh.plan->paths, first.plan->paths);
}

INSTANTIATE_TEST_SUITE_P(Builtin, SolverConformance,
                         ::testing::Combine(::testing::ValuesIn(availableSolvers().names()),
                                            ::testing::Values(Objective::kMakespan,
                                                              Objective::kSumOfCosts)),
                         [](const auto& info) {
                           return std::get<0>(info.param) + "_" + toString(std::get<1>(info.param));
                         });

}  // namespace
}  // namespace split_mapf
