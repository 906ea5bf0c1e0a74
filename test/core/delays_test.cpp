#include "split_mapf/core/delays.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

struct Counted {
  double share = 0;  // of the time delayed
  std::vector<std::uint32_t> lengths;
};

Counted count(const DelayModel& model, std::uint32_t robots, std::uint32_t steps) {
  Delays delays(model, robots);
  std::vector<std::uint32_t> run(robots, 0);
  Counted counted;
  std::uint64_t delayed = 0;
  for (std::uint32_t t = 0; t < steps; ++t) {
    delays.nextStep();
    for (std::uint32_t i = 0; i < robots; ++i) {
      if (delays.isDelayed(i)) {
        ++run[i];
        ++delayed;
      } else if (run[i] > 0) {
        counted.lengths.push_back(run[i]);
        run[i] = 0;
      }
    }
  }
  counted.share = static_cast<double>(delayed) / robots / steps;
  return counted;
}

TEST(Delays, LastAsLongAsTheModelSays) {
  for (const DelayProcess process : {DelayProcess::kBernoulli, DelayProcess::kPoisson}) {
    for (const DelayDistribution distribution :
         {DelayDistribution::kUniform, DelayDistribution::kGaussian}) {
      SCOPED_TRACE(toString(process) + " " + toString(distribution));
      // Rare ones, so that hardly any two follow one another.
      const Counted counted = count({0.0005, 10, 30, process, distribution, 7}, 200, 10000);
      ASSERT_GT(counted.lengths.size(), 500U);
      double sum = 0;
      std::uint32_t inside = 0;
      for (const std::uint32_t length : counted.lengths) {
        EXPECT_GE(length, 10U);
        inside += length <= 30 ? 1 : 0;
        sum += length;
      }
      EXPECT_GE(inside, counted.lengths.size() * 0.97);
      EXPECT_NEAR(sum / static_cast<double>(counted.lengths.size()), 20, 1);
      EXPECT_NEAR(counted.share, 0.0005 * 20 / (1 + 0.0005 * 20), 0.0015);
    }
  }
}

TEST(Delays, GaussianOnesKeepToTheMiddle) {
  const auto middle = [](DelayDistribution distribution) {
    const Counted counted =
        count({0.001, 10, 30, DelayProcess::kBernoulli, distribution, 1}, 100, 5000);
    double inside = 0;
    for (const std::uint32_t length : counted.lengths) inside += length >= 17 && length <= 23;
    return inside / static_cast<double>(counted.lengths.size());
  };
  EXPECT_NEAR(middle(DelayDistribution::kUniform), 7.0 / 21, 0.06);
  EXPECT_NEAR(middle(DelayDistribution::kGaussian), 0.7, 0.06);
}

TEST(Delays, AreTheSameForASeed) {
  const auto draw = [](std::uint64_t seed) {
    Delays delays({0.1, 1, 5, DelayProcess::kPoisson, DelayDistribution::kUniform, seed}, 30);
    std::vector<bool> all;
    for (int t = 0; t < 50; ++t) {
      delays.nextStep();
      for (std::uint32_t i = 0; i < 30; ++i) all.push_back(delays.isDelayed(i));
    }
    return all;
  };
  EXPECT_EQ(draw(1), draw(1));
  EXPECT_NE(draw(1), draw(2));
}

TEST(Delays, NoneWithoutProbability) {
  EXPECT_EQ(count({}, 10, 100).share, 0);
  EXPECT_EQ(count({1, 2, 2}, 10, 100).share, 1);
}

TEST(Delays, RefuseWhatCannotBe) {
  EXPECT_THROW(requireValid({-0.1}), OptionError);
  EXPECT_THROW(requireValid({1.5}), OptionError);
  EXPECT_THROW(requireValid({std::numeric_limits<double>::quiet_NaN()}), OptionError);
  EXPECT_THROW(requireValid({0.1, 0, 1}), OptionError);
  EXPECT_THROW(requireValid({0.1, 5, 4}), OptionError);
  EXPECT_THROW(parseDelayProcess("Bernoulli"), OptionError);
  EXPECT_THROW(parseDelayDistribution("normal"), OptionError);
}

}  // namespace
}  // namespace split_mapf
