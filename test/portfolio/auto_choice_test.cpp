#include "portfolio/auto_choice.h"

#include <gtest/gtest.h>

#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

// Times grow with the number of robots, but for `sturdy`; `rough` is a little sooner than that, but
// makes worse plans; `hopeless` is sooner than all and its plans cost twice the bound.
constexpr const char* kModel = R"(methods:
  - {solver: quick, objective: makespan, log_seconds: [-9, 2, 0, 0, 0, 0, 0],
     log_excess: [-9, 0, 0, 0, 0, 0, 0]}
  - {solver: sturdy, objective: makespan, log_seconds: [0, 0, 0, 0, 0, 0, 0],
     log_excess: [-9, 0, 0, 0, 0, 0, 0]}
  - {solver: rough, objective: makespan, log_seconds: [-0.1, 0, 0, 0, 0, 0, 0],
     log_excess: [-2, 0, 0, 0, 0, 0, 0]}
  - {solver: hopeless, objective: makespan, log_seconds: [-20, 0, 0, 0, 0, 0, 0],
     log_excess: [0, 0, 0, 0, 0, 0, 0]}
)";

AutoQuestion question(std::uint32_t robots) {
  AutoQuestion question;
  question.features.robots = robots;
  question.features.cells = 1000;
  question.features.largest_group = 1;
  question.solvers = {{"quick", {}}, {"rough", {}}, {"sturdy", {}}, {"hopeless", {}}};
  return question;
}

TEST(AutoChoice, TheSoonestAndOfThoseAboutAsSoonTheBest) {
  const CostModel model(kModel);
  EXPECT_EQ(chooseMethod(question(10), model).solver, "quick");
  EXPECT_EQ(chooseMethod(question(1000), model).solver, "sturdy");
  AutoQuestion without = question(1000);
  without.solvers = {{"quick", {}}, {"rough", {}}, {"hopeless", {}}};
  EXPECT_EQ(chooseMethod(without, model).solver, "rough");
  without.solvers = {{"hopeless", {}}};
  EXPECT_EQ(chooseMethod(without, model).solver, "hopeless");
}

TEST(AutoChoice, ACrowdsTurnWasTimeThatAnotherNeeded) {
  const CostModel model(R"(methods:
  - {solver: sturdy, objective: makespan, log_seconds: [2, 0, 0, 0, 0, 0, 0],
     log_excess: [-9, 0, 0, 0, 0, 0, 0]}
)");
  const auto turn = [&](std::uint32_t robots, std::uint32_t cells) {
    AutoQuestion asked = question(robots);
    asked.features.cells = cells;
    return static_cast<double>(chooseMethod(asked, model).turn);
  };
  EXPECT_NEAR(turn(5000, 20000) / turn(4000, 20000), 6.0 / 25, 1e-6);
  EXPECT_EQ(turn(5000, 1000000), turn(4000, 1000000)) << "there is room for all";
}

TEST(AutoChoice, LargeTeamsOnWideMapsWaitedForASearchThatTookFarMoreThanExpected) {
  const CostModel model(R"(methods:
  - {solver: ecbs, objective: makespan, log_seconds: [0, 0, 0, 0, 0, 0, 0],
     log_excess: [-9, 0, 0, 0, 0, 0, 0]}
  - {solver: conflict_optimizer, objective: makespan, log_seconds: [2, 0, 0, 0, 0, 0, 0],
     log_excess: [-9, 0, 0, 0, 0, 0, 0]}
)");
  AutoQuestion asked = question(5000);
  asked.solvers = builtinSolvers().traits();
  asked.features.cells = 1000000;
  EXPECT_EQ(chooseMethod(asked, model).solver, "conflict_optimizer");
  AutoQuestion other = asked;
  other.features.robots = 4000;
  EXPECT_EQ(chooseMethod(other, model).solver, "ecbs") << "no large team";
  other = asked;
  other.features.cells = 40000;
  EXPECT_EQ(chooseMethod(other, model).solver, "ecbs") << "a crowd";
  other = asked;
  other.features.head_on = 1;
  EXPECT_EQ(chooseMethod(other, model).solver, "ecbs") << "who is placed would jam";
  other = asked;
  other.solvers.erase("conflict_optimizer");
  EXPECT_EQ(chooseMethod(other, model).solver, "ecbs") << "nobody places robots";
}

TEST(AutoChoice, CalledASolverOfAllTablesFirstWhereThereIsNoRoomForThem) {
  AutoQuestion asked = question(10);
  asked.solvers["sturdy"].keeps_step_table = true;
  const CostModel model(kModel);
  EXPECT_EQ(chooseMethod(asked, model).solver, "quick");
  asked.one_by_one = true;
  EXPECT_EQ(chooseMethod(asked, model).solver, "sturdy");
  asked.features.head_on = 1;
  EXPECT_EQ(chooseMethod(asked, model).solver, "sturdy");
  asked.solvers["sturdy"].keeps_step_table = false;
  EXPECT_EQ(chooseMethod(asked, model).solver, "quick") << "there is nobody else";
}

TEST(AutoChoice, ALoosePlanBeforeRefinementWhereRobotsMeetHeadOn) {
  const CostModel model(R"(methods:
  - {solver: tight, objective: sum_of_costs, log_seconds: [-0.4, 0, 0, 0, 0, 0, 1],
     log_excess: [-1, 0, 0, 0, 0, 0, 0]}
  - {solver: lacam, objective: sum_of_costs, log_seconds: [0.5, 0, 0, 0, 0, 0, 0],
     log_excess: [-0.3, 0, 0, 0, 0, 0, 0]}
)");
  AutoQuestion asked = question(100);
  asked.objective = Objective::kSumOfCosts;
  asked.solvers = {{"tight", {}}, {"lacam", builtinSolvers().info("lacam").traits}};
  asked.refines = true;
  asked.features.head_on = 0.1;
  EXPECT_EQ(chooseMethod(asked, model).solver, "tight") << "far sooner";
  asked.features.head_on = 0.8;
  EXPECT_EQ(chooseMethod(asked, model).solver, "tight") << "as soon, and robots can pass";
  asked.features.head_on = 1.0;
  EXPECT_EQ(chooseMethod(asked, model).solver, "lacam");
  asked.splits = true;
  EXPECT_EQ(chooseMethod(asked, model).solver, "tight") << "its pieces are packed as ever";
  asked.splits = false;
  EXPECT_EQ(chooseMethod(asked, model).solver, "lacam");
  asked.refines = false;
  EXPECT_EQ(chooseMethod(asked, model).solver, "tight") << "as the first plan is the last";
}

TEST(AutoChoice, TheSolverDoesNotDependOnTheThreads) {
  // Whoever took credit for 4 processors would place robots here.
  const CostModel model(R"(methods:
  - {solver: conflict_optimizer, objective: makespan,
     log_seconds: [0.7, 0, 0, 0, 0, 0, 0], log_excess: [-1, 0, 0, 0, 0, 0, 0]}
  - {solver: lacam, objective: makespan, log_seconds: [0, 0, 0, 0, 0, 0, 0],
     log_excess: [-1, 0, 0, 0, 0, 0, 0]}
)");
  AutoQuestion asked = question(100);
  asked.solvers = builtinSolvers().traits();
  EXPECT_EQ(chooseMethod(asked, model).solver, "lacam");
}

TEST(AutoChoice, ATurnIsManyTimesWhatIsExpectedAndShorterInJams) {
  const CostModel model(kModel);
  const AutoQuestion asked = question(1000);
  ASSERT_EQ(chooseMethod(asked, model).solver, "sturdy") << "a second is expected";
  const std::uint64_t turn = chooseMethod(asked, model).turn;
  EXPECT_GT(turn, 10'000'000U) << "expansions that take 5 s at least";
  AutoQuestion jammed = asked;
  jammed.features.head_on = 1;
  EXPECT_LT(chooseMethod(jammed, model).turn, turn / 2);
  EXPECT_GT(chooseMethod(jammed, model).turn, 0U);
  EXPECT_GT(chooseMethod(question(1), model).turn, 100'000U) << "hardly any time is expected";
  AutoQuestion unknown = asked;
  unknown.solvers = {{"unheard_of", {}}};
  EXPECT_EQ(chooseMethod(unknown, model).solver, "unheard_of");
  EXPECT_EQ(chooseMethod(unknown, model).turn, 0U);
}

TEST(AutoChoice, TheLastResortHasNobodyToYieldTo) {
  const CostModel model(R"(methods:
  - {solver: lacam, objective: makespan, log_seconds: [0, 0, 0, 0, 0, 0, 0],
     log_excess: [-1, 0, 0, 0, 0, 0, 0]}
)");
  AutoQuestion asked = question(100);
  asked.solvers = {{"lacam", builtinSolvers().info("lacam").traits}};
  EXPECT_EQ(chooseMethod(asked, model).turn, 0U);
}

TEST(AutoChoice, NeverASolverThatIsNotThere) {
  const CostModel model(kModel);
  AutoQuestion asked = question(10);
  asked.solvers = {{"sturdy", {}}};
  EXPECT_EQ(chooseMethod(asked, model).solver, "sturdy");
}

TEST(CostModel, TheShippedOneKnowsTheSolversAndBothObjectives) {
  InstanceFeatures features;
  features.robots = 100;
  features.cells = 1000;
  features.makespan_bound = 50;
  features.sum_bound = 2000;
  features.conflicting = 200;
  features.largest_group = 90;
  for (const Objective objective : {Objective::kMakespan, Objective::kSumOfCosts}) {
    const auto estimates = CostModel::shipped().estimate(features, objective);
    EXPECT_GE(estimates.size(), 4U);
    for (const MethodEstimate& method : estimates) {
      EXPECT_GT(method.seconds, 1e-5) << method.solver;
      EXPECT_LT(method.seconds, 60) << method.solver;
    }
  }
}

TEST(CostModel, SaysWhatIsWrongWithItsData) {
  EXPECT_THROW(CostModel("methods: []"), InputError);
  EXPECT_THROW(CostModel("{"), InputError);
  EXPECT_THROW(CostModel("methods: [{solver: a, objective: makespan,"
                         " log_seconds: [1], log_excess: [1]}]"),
               InputError);
}

}  // namespace
}  // namespace split_mapf
