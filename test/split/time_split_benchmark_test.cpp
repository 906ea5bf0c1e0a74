#include <gtest/gtest.h>

#include <algorithm>

#include "split_mapf/io/movingai.h"
#include "split_mapf/split/time_split.h"
#include "support/benchmarks.h"

namespace split_mapf {
namespace {

/// The greatest ratio of the pieces' summed lower bounds to the whole's, over the first five
/// random scenarios, up to 200 robots and 2 to 6 pieces.
double worstRatio(const std::string& map, TimeSplitVariant variant) {
  const auto grid = readMovingAiMap(*test::benchmarkFile("movingai/" + map + ".map"));
  double worst = 0;
  for (int scenario = 1; scenario <= 5; ++scenario) {
    const std::string file = "movingai/" + map + "-random-" + std::to_string(scenario) + ".scen";
    for (const std::uint32_t robots : {50U, 100U, 150U, 200U}) {
      const Scenario rows = readMovingAiScenario(*test::benchmarkFile(file), *grid, robots);
      const Instance instance(grid, rows.starts, rows.goals);
      for (std::uint32_t pieces = 2; pieces <= 6; ++pieces) {
        TimeSplitOptions options;
        options.ratios.assign(pieces, 1.0 / pieces);
        options.variant = variant;
        const auto tree = splitTime(instance, options, Deadline());
        double sum = 0;
        for (const Piece& leaf : *tree) {
          sum += variant == TimeSplitVariant::kMakespan
                     ? makespanLowerBound(*leaf.instance)
                     : static_cast<double>(sumOfCostsLowerBound(*leaf.instance));
        }
        const double whole = variant == TimeSplitVariant::kMakespan
                                 ? makespanLowerBound(instance)
                                 : static_cast<double>(sumOfCostsLowerBound(instance));
        worst = std::max(worst, sum / whole);
      }
    }
  }
  return worst;
}

class PieceBounds : public testing::TestWithParam<TimeSplitVariant> {};

TEST_P(PieceBounds, AddUpToTheWholesOnTheBenchmark) {
  if (!test::benchmarkFile("movingai/random-32-32-10-random-5.scen")) {
    GTEST_SKIP() << test::benchmarkMissing("movingai/random-32-32-10-random-5.scen");
  }
  const double worst = worstRatio("random-32-32-10", GetParam());
  RecordProperty("worst_ratio", std::to_string(worst));
  EXPECT_LE(worst, 1.001);
}

INSTANTIATE_TEST_SUITE_P(Variants, PieceBounds,
                         testing::Values(TimeSplitVariant::kMakespan,
                                         TimeSplitVariant::kSumOfCosts));

}  // namespace
}  // namespace split_mapf
