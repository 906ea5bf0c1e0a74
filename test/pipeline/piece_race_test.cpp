#include "pipeline/piece_race.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "split_mapf/solver/registry.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

/// Stands in for workers, whose answers a test writes itself.
class ScriptedWorkers : public PieceWorkers {
 public:
  class Asked : public Batch {
   public:
    explicit Asked(std::set<std::size_t>& withdrawn) : withdrawn_(withdrawn) {}
    void withdraw(std::size_t question) override { withdrawn_.insert(question); }

   private:
    std::set<std::size_t>& withdrawn_;
  };

  bool know(const std::string& /*solver*/) const override { return true; }
  std::unique_ptr<Batch> ask(const std::vector<PieceQuestion>& /*questions*/,
                             Listener to_tell) override {
    listener = std::move(to_tell);
    return std::make_unique<Asked>(withdrawn);
  }

  Listener listener;
  std::set<std::size_t> withdrawn;
};

class PieceRaceTest : public ::testing::Test {
 protected:
  PieceRaceTest() {
    piece_.instance = std::make_shared<const Instance>(test::generatedInstance(6, 0.1, 4));
    piece_.robots = {0, 1, 2, 3};
  }

  /// Of so many equal pieces; greater indices are expected to take less. All but the first are
  /// asked.
  PieceRace& start(std::size_t pieces, std::uint32_t shares = 1) {
    piece_.shares = shares;
    std::vector<PieceRace::Entry> entries;
    std::vector<std::size_t> asked;
    std::vector<PieceQuestion> questions;
    std::vector<SubproblemReport> rows;
    for (std::size_t i = 0; i < pieces; ++i) {
      const auto piece = std::make_shared<const Piece>(piece_);
      entries.push_back({piece, 100.0 - static_cast<double>(i)});
      if (i == 0) continue;
      asked.push_back(i);
      questions.push_back({piece, "ecbs", {}, 1});
      rows.emplace_back();
    }
    race_ = std::make_unique<PieceRace>(std::move(entries), nullptr,
                                        [this](const SolveResult&) { ++done_; });
    race_->ask(workers_, asked, questions, std::move(rows));
    return *race_;
  }

  /// A right answer that is told from others by its message.
  SolveResult solved(const std::string& message) const {
    SolveResult result = builtinSolvers().create("prioritized", {})->solve(*piece_.instance, {});
    EXPECT_TRUE(result.plan);
    result.message = message;
    return result;
  }

  PieceAnswer answer() const { return {solved("away"), 5, 0.5}; }
  PieceRace::Outcome here() const { return {solved("here"), {}}; }

  Piece piece_;
  ScriptedWorkers workers_;
  std::unique_ptr<PieceRace> race_;
  int done_ = 0;
};

TEST_F(PieceRaceTest, ThreadsDrawLongestFirstAndTakeItFromTheWorkers) {
  PieceRace& race = start(3);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto draw = race.draw();
    ASSERT_TRUE(draw);
    EXPECT_EQ(draw->entry, i);
    race.finish(i, here());
  }
  EXPECT_FALSE(race.draw());
  EXPECT_EQ(workers_.withdrawn, (std::set<std::size_t>{0, 1}));
  EXPECT_EQ(done_, 3);
}

TEST_F(PieceRaceTest, WhatWorkersHaveBegunComesLast) {
  PieceRace& race = start(3);
  EXPECT_TRUE(workers_.listener.begun(0));  // entry 1
  EXPECT_EQ(race.draw()->entry, 0U);
  EXPECT_EQ(race.draw()->entry, 2U);
  EXPECT_FALSE(workers_.listener.begun(1));  // a thread was sooner
  EXPECT_EQ(race.draw()->entry, 1U);         // nobody waits for somebody who may have gone
  EXPECT_FALSE(race.draw());
}

TEST_F(PieceRaceTest, TheFirstAnswerWins) {
  PieceRace& race = start(3);
  race.draw();
  race.finish(0, here());
  workers_.listener.begun(0);
  workers_.listener.begun(1);
  const auto first = race.draw();
  const auto second = race.draw();
  ASSERT_TRUE(first && second);
  EXPECT_FALSE(second->stop->requested());
  workers_.listener.answered(second->entry - 1, answer());
  EXPECT_TRUE(second->stop->requested());
  EXPECT_FALSE(first->stop->requested());
  race.finish(second->entry, here());
  race.finish(first->entry, here());
  workers_.listener.answered(first->entry - 1, answer());
  workers_.listener.answered(first->entry - 1, answer());
  EXPECT_EQ(done_, 3);
  const auto outcomes = race.take();
  EXPECT_EQ(outcomes[first->entry].result.message, "here");
  EXPECT_EQ(outcomes[second->entry].result.message, "away");
  EXPECT_EQ(outcomes[second->entry].row.horizon, 5U);
  EXPECT_EQ(outcomes[second->entry].row.status, "solved");
  EXPECT_EQ(workers_.withdrawn, (std::set<std::size_t>{first->entry - 1}));
}

TEST_F(PieceRaceTest, AnAnswerNeedsNoBeginning) {
  PieceRace& race = start(2);
  workers_.listener.answered(0, answer());
  EXPECT_EQ(race.draw()->entry, 0U);
  EXPECT_FALSE(race.draw());
  EXPECT_EQ(done_, 1);
}

TEST_F(PieceRaceTest, AWrongAnswerCountsForNothing) {
  const PieceAnswer right = answer();
  std::vector<PieceAnswer> wrong(7, right);
  std::swap(wrong[0].result.plan->paths[0], wrong[0].result.plan->paths[1]);
  wrong[1].result.plan->paths.pop_back();
  wrong[2].result.plan->paths.emplace_back();
  wrong[3].result.plan->paths[2].front() = 4000000000U;
  wrong[4].result.plan->paths[0] = {};
  wrong[5].result.plan.reset();
  wrong[5].result.termination = Termination::kUnsolvable;
  wrong[6].result.plan.reset();
  wrong[6].result.termination = Termination::kTimeout;
  for (std::size_t i = 0; i < wrong.size(); ++i) {
    SCOPED_TRACE(i);
    done_ = 0;
    PieceRace& race = start(2);
    workers_.listener.begun(0);
    workers_.listener.answered(0, wrong[i]);
    EXPECT_EQ(done_, 0);
    race.finish(race.draw()->entry, here());
    const auto draw = race.draw();
    ASSERT_TRUE(draw);
    EXPECT_FALSE(draw->stop->requested());
    workers_.listener.answered(0, right);
    EXPECT_EQ(race.take()[1].result.message, "away");
  }
}

TEST_F(PieceRaceTest, ToGiveUpIsAnAnswerWhereThereIsALimit) {
  PieceAnswer without;
  for (const std::uint32_t shares : {0U, 1U}) {
    done_ = 0;
    start(2, shares);
    workers_.listener.answered(0, without);
    EXPECT_EQ(done_, static_cast<int>(shares));
  }
}

}  // namespace
}  // namespace split_mapf
