// What ends a refinement: the proof that nothing is left to gain.
#include "improve/settlement.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "solver/joint/group_search.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/pipeline/planner.h"
#include "split_mapf/solver/registry.h"
#include "support/ascii_grid.h"
#include "support/placed_plan.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

constexpr double kPatienceSec = 60;

/// Robot a is at home in the middle and has to stay or pay: 12 steps, 8 by shortest paths.
Instance oneStays() {
  return test::instanceFromAscii({".c.",  //
                                  "ba.",  //
                                  "..d"},
                                 {"d..",  //
                                  ".ab",  //
                                  ".c."});
}

/// Four robots change their order at the end of a tunnel.
Instance tunnel() {
  return test::instanceFromAscii({"###.", "....", "###a", "###b", "###c", "###d"},
                                 {"###.", "....", "###d", "###c", "###b", "###a"});
}

/// Two robots at home leave their cells to one that passes.
Instance vanishing() {
  return test::instanceFromAscii({"c..ab..", "##.####"}, {"...ab.c", "##.####"});
}

struct Fault {
  const char* name;
  Instance (*instance)();
  std::uint64_t makespan;
  std::uint64_t sum_of_costs;

  std::uint64_t optimum(Objective objective) const {
    return objective == Objective::kMakespan ? makespan : sum_of_costs;
  }
};

class RefineToTheProof : public ::testing::TestWithParam<std::tuple<Fault, Objective>> {
 protected:
  PlanReport plan(const std::string& solver, double refine_sec) {
    PlanRequest request;
    request.solver = solver;
    request.objective = std::get<1>(GetParam());
    request.refine_sec = refine_sec;
    Executor executor(2);
    return Planner(builtinSolvers(), executor)
        .plan(std::get<0>(GetParam()).instance(), request, Deadline(kPatienceSec));
  }
};

TEST_P(RefineToTheProof, EndsThereAndNotWhenItsTimeIsUp) {
  const auto& [fault, objective] = GetParam();
  for (const char* solver : {"auto", "lacam"}) {
    const PlanReport report = plan(solver, kPatienceSec);
    ASSERT_TRUE(report.plan) << report.message;
    EXPECT_TRUE(validate(fault.instance(), *report.plan).empty());
    EXPECT_EQ(costOf(*report.plan, objective), fault.optimum(objective)) << solver;
    EXPECT_TRUE(report.optimal) << solver;
    EXPECT_EQ(report.proved_lower_bound, fault.optimum(objective));
    EXPECT_LT(report.runtime_sec, kPatienceSec / 3) << solver;
    if (objective != Objective::kMakespan) continue;
    EXPECT_EQ(report.sum_of_costs, fault.sum_of_costs) << "within the makespan, too, here";
    EXPECT_NE(report.message.find("its makespan is proved, refinement went on with the sum of "
                                  "costs"),
              std::string::npos)
        << report.message;
    EXPECT_NE(report.message.find("the least within it"), std::string::npos) << report.message;
  }
}

TEST_P(RefineToTheProof, AutoProvesItWithoutRefinement) {
  const auto& [fault, objective] = GetParam();
  const PlanReport report = plan("auto", 0);
  ASSERT_TRUE(report.plan) << report.message;
  EXPECT_EQ(costOf(*report.plan, objective), fault.optimum(objective));
  EXPECT_TRUE(report.optimal);
  EXPECT_NE(report.certified_by, "");
}

INSTANTIATE_TEST_SUITE_P(Faults, RefineToTheProof,
                         ::testing::Combine(::testing::Values(Fault{"one_stays", oneStays, 4, 12},
                                                              Fault{"tunnel", tunnel, 15, 53},
                                                              Fault{"vanishing", vanishing, 9, 25}),
                                            ::testing::Values(Objective::kMakespan,
                                                              Objective::kSumOfCosts)),
                         [](const auto& info) {
                           return std::get<0>(info.param).name +
                                  ("_" + toString(std::get<1>(info.param)));
                         });

TEST(Settlement, TurnsEndWhereThereAreTooManyStates) {
  const Instance instance = test::generatedInstance(8, 0, 40);
  const Plan plan = test::planWithDelays(instance);
  Settlement settlement(instance, Objective::kSumOfCosts, 0);
  EXPECT_EQ(settlement.lowerBound(), sumOfCostsLowerBound(instance));
  int turns = 0;
  while (settlement.isOpen(plan) && turns < 10) {
    EXPECT_FALSE(settlement.takeTurn(plan, Deadline(0.05)));
    ++turns;
  }
  EXPECT_LT(turns, 10);
  EXPECT_GE(settlement.lowerBound(), sumOfCostsLowerBound(instance));
  EXPECT_LE(settlement.lowerBound(), sumOfCostsOf(plan));
}

TEST(GroupSearch, OnlyGainsAndIsValidAfterEveryGroup) {
  const Instance instance = test::generatedInstance(10, 0.1, 35);
  const Plan first = test::planWithDelays(instance);
  GroupSearch search(instance, first, makespanOf(first), 1);
  std::uint64_t cost = sumOfCostsOf(first);
  for (int i = 0; i < 60; ++i) {
    cost -= search.tryOne(Deadline());
    ASSERT_EQ(sumOfCostsOf(search.plan()), cost);
    ASSERT_TRUE(validate(instance, search.plan()).empty()) << i;
    ASSERT_LE(makespanOf(search.plan()), makespanOf(first));
  }
  EXPECT_LT(cost, sumOfCostsOf(first));
}

TEST(GroupSearch, FindsARobotThatMakesRoomAndComesBack) {
  // Robot b waits for a at home and a goes round: 2 + 0 by shortest ways.
  const Instance instance = vanishing();
  PlanRequest request;
  request.solver = "lacam";
  request.split = "none";
  request.objective = Objective::kSumOfCosts;
  Executor executor(1);
  const PlanReport report =
      Planner(builtinSolvers(), executor).plan(instance, request, Deadline(kPatienceSec));
  ASSERT_TRUE(report.plan);
  GroupSearch search(instance, *report.plan, makespanOf(*report.plan), 0);
  for (int i = 0; i < 200; ++i) search.tryOne(Deadline());
  EXPECT_EQ(sumOfCostsOf(search.plan()), 25U);
}

}  // namespace
}  // namespace split_mapf
