#include "split_mapf/pipeline/piece_messages.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>

#include "split_mapf/core/error.h"
#include "split_mapf/pipeline/piece_bytes.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

PieceQuestion question() {
  Piece piece;
  const Instance instance = test::generatedInstance(6, 0.1, 4);
  piece.instance = std::make_shared<const Instance>(instance);
  piece.robots = {4, 7, 9, 1000};
  PieceQuestion asked;
  asked.piece = std::make_shared<const Piece>(piece);
  asked.solver = "ecbs";
  asked.options.objective = Objective::kSumOfCosts;
  asked.options.suboptimality = 1.25;
  asked.options.seed = std::numeric_limits<std::uint64_t>::max();
  asked.options.expansion_limit = 1ULL << 40U;
  asked.options.values = {{"a", "1"}, {"name", std::string("v\0w", 3)}};
  asked.limit_sec = std::numeric_limits<double>::infinity();
  return asked;
}

PieceAnswer answer() {
  PieceAnswer given;
  given.result.termination = Termination::kSolved;
  given.result.plan = Plan{{{0, 1, 2}, {}, {70000}}};
  given.result.lower_bound = 1ULL << 50U;
  given.result.optimal = true;
  given.result.certified_by = "somebody";
  given.result.message = "a \"message\"";
  given.result.high_level_nodes = 3;
  given.result.low_level_expansions = 1ULL << 33U;
  given.horizon = 17;
  given.seconds = 0.125;
  return given;
}

/// That every beginning is refused, and that no changed byte is worse than a refusal.
template <typename Read>
void expectBounds(const std::string& bytes, const Read& read) {
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_THROW(read(bytes.substr(0, length)), InputError) << length;
  }
  EXPECT_THROW(read(bytes + "."), InputError);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const char flip : {'\x01', '\x10', '\x7f', '\x80'}) {
      std::string wrong = bytes;
      wrong[i] = static_cast<char>(wrong[i] ^ flip);
      try {
        read(wrong);
      } catch (const InputError&) {  // as it should be
      }
    }
  }
}

TEST(PieceMessages, AQuestionArrivesAsItWasAsked) {
  const PieceQuestion asked = question();
  const std::string bytes = toBytes(asked);
  const PieceQuestion read = questionFromBytes(bytes);
  EXPECT_EQ(toBytes(read), bytes);
  EXPECT_EQ(read.solver, asked.solver);
  EXPECT_EQ(read.options.objective, asked.options.objective);
  EXPECT_EQ(read.options.suboptimality, asked.options.suboptimality);
  EXPECT_EQ(read.options.seed, asked.options.seed);
  EXPECT_EQ(read.options.expansion_limit, asked.options.expansion_limit);
  EXPECT_EQ(read.options.values, asked.options.values);
  EXPECT_EQ(read.limit_sec, asked.limit_sec);
  EXPECT_EQ(toBytes(*read.piece), toBytes(*asked.piece));
  expectBounds(bytes, questionFromBytes);
}

TEST(PieceMessages, AnAnswerArrivesAsItWasGiven) {
  const PieceAnswer given = answer();
  const std::string bytes = toBytes(given);
  const PieceAnswer read = answerFromBytes(bytes);
  EXPECT_EQ(toBytes(read), bytes);
  EXPECT_EQ(read.result.plan->paths, given.result.plan->paths);
  EXPECT_EQ(read.result.lower_bound, given.result.lower_bound);
  EXPECT_EQ(read.result.message, given.result.message);
  EXPECT_EQ(read.result.low_level_expansions, given.result.low_level_expansions);
  EXPECT_EQ(read.horizon, given.horizon);
  EXPECT_EQ(read.seconds, given.seconds);
  expectBounds(bytes, answerFromBytes);
}

TEST(PieceMessages, WhatContradictsItselfIsRefused) {
  PieceAnswer without_plan = answer();
  without_plan.result.plan.reset();
  EXPECT_THROW(answerFromBytes(toBytes(without_plan)), InputError);
  PieceAnswer with_plan = answer();
  with_plan.result.termination = Termination::kNoPlanFound;
  EXPECT_THROW(answerFromBytes(toBytes(with_plan)), InputError);
  PieceQuestion nowhere = question();
  nowhere.limit_sec = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(questionFromBytes(toBytes(nowhere)), InputError);
}

}  // namespace
}  // namespace split_mapf
