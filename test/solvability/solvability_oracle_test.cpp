// The rule is held against exhaustive search: the tests' evidence that it is exact. The fixed
// sample takes seconds, a long run has ten times as many cases;
// SPLIT_MAPF_SOLVABILITY_CASES=<number> runs so many cases of the same sequence, up to 10 vertices.
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <string>

#include "split_mapf/solvability/solvability.h"
#include "support/long_run.h"
#include "support/oracle.h"
#include "support/reachability.h"
#include "support/small_instances.h"
#include "support/solvability_cases.h"

namespace split_mapf {
namespace {

using test::Reachability;
using test::solvabilityCase;
using test::StepKind;

struct SampleSize {
  std::uint64_t cases = 20000;
  std::uint64_t most_arrangements = 10000;
};

SampleSize sampleSize() {
  SampleSize size;
  if (test::isLongRun()) size.cases *= 10;
  if (const char* wished = std::getenv("SPLIT_MAPF_SOLVABILITY_CASES")) {
    size.cases = std::stoull(wished);
    size.most_arrangements = 400000;
  }
  return size;
}

TEST(SolvabilityOracle, TheRuleAgreesWithExhaustiveSearch) {
  const SampleSize size = sampleSize();
  std::map<std::string, std::pair<int, int>> answers;  // family -> solvable, unsolvable
  std::map<RefusalKind, int> refusals;
  std::uint64_t cases = 0;
  std::uint64_t disagreements = 0;
  for (std::uint64_t seed = 0; cases < size.cases; ++seed) {
    const test::SolvabilityCase sample = solvabilityCase(seed, size.most_arrangements);
    const Reachability reachable(sample.graph, sample.starts);
    const SolvabilityChecker checker(sample.graph);
    for (const std::vector<Vertex>& goals : sample.goals) {
      const SolvabilityVerdict verdict = checker.check(sample.starts, goals);
      const bool is_solvable = reachable.reaches(goals);
      ++cases;
      ++(is_solvable ? answers[sample.family].first : answers[sample.family].second);
      ++refusals[verdict.refusal];
      if ((verdict.answer == Solvability::kSolvable) == is_solvable) continue;
      ++disagreements;
      ADD_FAILURE() << "seed " << seed << ", " << sample.family << ", the rule says "
                    << explain(verdict) << test::describe(sample.graph, sample.starts, goals);
      ASSERT_LT(disagreements, 5U);
    }
  }
  // The sample means something only if both answers come up everywhere, for every
  // reason.
  EXPECT_EQ(answers.size(), 11U);
  for (const auto& [family, count] : answers) {
    EXPECT_GT(count.first, 0) << family;
    // Where all cycles may rotate, no theta graph is an exception.
    EXPECT_EQ(count.second > 0, family != "theta") << family;
  }
  EXPECT_EQ(refusals.size(), 7U);
  RecordProperty("cases", std::to_string(cases));
  RecordProperty("disagreements", std::to_string(disagreements));
}

TEST(SolvabilityOracle, ElementaryStepsReachWhatSynchronousStepsReach) {
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const test::SolvabilityCase sample = solvabilityCase(seed, 400);
    const Reachability elementary(sample.graph, sample.starts, StepKind::kElementary);
    const Reachability synchronous(sample.graph, sample.starts, StepKind::kSynchronous);
    ASSERT_EQ(elementary.count(), synchronous.count())
        << "seed " << seed << test::describe(sample.graph, sample.starts, sample.starts);
    for (const std::vector<Vertex>& goals : sample.goals) {
      ASSERT_EQ(elementary.reaches(goals), synchronous.reaches(goals)) << "seed " << seed;
    }
  }
}

TEST(SolvabilityOracle, InstancesWithAnOptimumAreTheSolvableOnes) {
  int unsolvable = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Instance instance = test::smallInstance(seed);
    const bool has_plan = test::optimalCost(instance, Objective::kMakespan).has_value();
    const SolvabilityVerdict verdict = checkSolvable(instance);
    ASSERT_EQ(verdict.answer == Solvability::kSolvable, has_plan)
        << test::describe(instance) << explain(verdict, instance.grid());
    unsolvable += has_plan ? 0 : 1;
  }
  EXPECT_GT(unsolvable, 10);
}

}  // namespace
}  // namespace split_mapf
