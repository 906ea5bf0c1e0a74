// The one door to GLPK: right answers, and failures that stay inside.
#include "solver/ilp/glpk_model.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

namespace split_mapf::ilp {
namespace {

constexpr std::size_t kMemoryMb = 256;
constexpr double kTolerance = 1e-9;

/// minimise x + 2y subject to x + y >= 3 and x <= 2: x = 2, y = 1.
void fillSmallProblem(GlpkModel& model) {
  model.addRow(RowKind::kAtLeast, 3, {});
  model.addRow(RowKind::kAtMost, 2, {});
  model.addColumn(1, {{0, 1}, {1, 1}});
  model.addColumn(2, {{0}, {1}});
}

/// An assignment problem with `size` times `size` columns, which takes GLPK a while.
void fillLargeProblem(GlpkModel& model, int size) {
  for (int i = 0; i < 2 * size; ++i) model.addRow(RowKind::kAtLeast, 1, {});
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) {
      model.addColumn(1 + (i * 7919 + j * 104729) % 1009, {{i, size + j}, {1, 1}});
    }
  }
}

std::string failureOf(GlpkModel& model) {
  try {
    model.addColumn(1, {});
  } catch (const GlpkError& error) {
    return error.what();
  }
  return "none";
}

TEST(GlpkModel, SolvesAndTellsPrimalsAndDuals) {
  GlpkModel model(Deadline(), kMemoryMb);
  fillSmallProblem(model);
  ASSERT_EQ(model.solve(Simplex::kPrimal), LpStatus::kOptimal);
  EXPECT_NEAR(model.objective(), 4, kTolerance);
  EXPECT_NEAR(model.primal(0), 2, kTolerance);
  EXPECT_NEAR(model.primal(1), 1, kTolerance);
  EXPECT_NEAR(model.dual(0), 2, kTolerance);
  EXPECT_NEAR(model.dual(1), -1, kTolerance);
}

TEST(GlpkModel, CountsItsWorkTheSameEachTime) {
  std::uint64_t works[2] = {0, 0};
  for (std::uint64_t& work : works) {
    GlpkModel model(Deadline(), kMemoryMb);
    EXPECT_EQ(model.work(), 0U);
    fillLargeProblem(model, 20);
    ASSERT_EQ(model.solve(Simplex::kPrimal), LpStatus::kOptimal);
    work = model.work();
  }
  EXPECT_GE(works[0], 20U * (40 + 400)) << "it takes an iteration a row at least";
  EXPECT_EQ(works[0], works[1]);
}

TEST(GlpkModel, GoesOnAfterChanges) {
  GlpkModel model(Deadline(), kMemoryMb);
  fillSmallProblem(model);
  ASSERT_EQ(model.solve(Simplex::kPrimal), LpStatus::kOptimal);
  model.addRow(RowKind::kAtMost, 0.5, {{1}, {1}});
  EXPECT_EQ(model.solve(Simplex::kDual), LpStatus::kInfeasible);
  model.addColumn(5, {{0}, {1}});
  ASSERT_EQ(model.solve(Simplex::kPrimal), LpStatus::kOptimal);
  EXPECT_NEAR(model.objective(), 2 + 1 + 2.5, kTolerance);
  model.deleteRows({2});
  model.setBounds(0, 0, 0);
  ASSERT_EQ(model.solve(Simplex::kDual), LpStatus::kOptimal);
  EXPECT_NEAR(model.objective(), 6, kTolerance);
  model.deleteColumns({1});
  ASSERT_EQ(model.solve(Simplex::kDual), LpStatus::kOptimal);
  EXPECT_NEAR(model.objective(), 15, kTolerance);
  EXPECT_EQ(model.columns(), 2);
  EXPECT_EQ(model.rows(), 2);
}

TEST(GlpkModel, TurnsMisuseIntoAnErrorAndFreesTheThread) {
  {
    GlpkModel model(Deadline(), kMemoryMb);
    fillSmallProblem(model);
    EXPECT_THROW(model.addRow(RowKind::kAtMost, 1, {{7}, {1}}), GlpkError);  // no such column
    EXPECT_NE(failureOf(model).find("given up"), std::string::npos);
    EXPECT_THROW(model.solve(Simplex::kPrimal), GlpkError);
  }
  GlpkModel next(Deadline(), kMemoryMb);
  fillSmallProblem(next);
  EXPECT_EQ(next.solve(Simplex::kPrimal), LpStatus::kOptimal);
}

TEST(GlpkModel, SaysThatMemoryRanOut) {
  GlpkModel model(Deadline(), 1);
  try {
    fillLargeProblem(model, 300);
    FAIL() << "300 x 300 columns in 1 MiB";
  } catch (const GlpkError& error) {
    EXPECT_EQ(error.kind(), GlpkError::Kind::kMemory);
    EXPECT_STREQ(error.what(), "GLPK needs more than 1 MiB");
  }
}

TEST(GlpkModel, RefusesASecondModelOnTheThread) {
  std::optional<GlpkModel> first(std::in_place, Deadline(), kMemoryMb);
  EXPECT_THROW(GlpkModel(Deadline(), kMemoryMb), std::logic_error);
  std::thread([] { EXPECT_NO_THROW(GlpkModel(Deadline(), kMemoryMb)); }).join();
  first.reset();
  EXPECT_NO_THROW(GlpkModel(Deadline(), kMemoryMb));
}

TEST(GlpkModel, LeavesALongSimplexSoonAfterTheFlagIsRaised) {
  const auto stop = std::make_shared<StopFlag>();
  GlpkModel model(Deadline(-1, stop), kMemoryMb);
  fillLargeProblem(model, 220);
  Deadline::Clock::time_point raised;
  std::thread raiser([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    raised = Deadline::Clock::now();
    stop->request();
  });
  const LpStatus status = model.solve(Simplex::kPrimal);
  const auto now = Deadline::Clock::now();
  raiser.join();
  ASSERT_EQ(status, LpStatus::kInterrupted) << "the problem was too small for this test";
  EXPECT_LT(std::chrono::duration<double>(now - raised).count(), 0.2);
  EXPECT_EQ(model.memoryBytes(), 0U);
}

}  // namespace
}  // namespace split_mapf::ilp
