#include "split_mapf/split/split_spec.h"

#include <gtest/gtest.h>

#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

TEST(SplitSpec, NoneAndAuto) {
  EXPECT_EQ(parseSplitSpec("none").kind, SplitSpec::Kind::kNone);
  EXPECT_EQ(parseSplitSpec("auto").kind, SplitSpec::Kind::kNone);
}

TEST(SplitSpec, EqualTimes) {
  const SplitSpec spec = parseSplitSpec("4t");
  EXPECT_EQ(spec.kind, SplitSpec::Kind::kSplit);
  EXPECT_FALSE(spec.space);
  ASSERT_EQ(spec.time_ratios.size(), 4U);
  EXPECT_DOUBLE_EQ(spec.time_ratios[3], 0.25);
}

TEST(SplitSpec, RatiosOfTime) {
  const SplitSpec spec = parseSplitSpec("t(0.2,0.3,5e-1)");
  ASSERT_EQ(spec.time_ratios.size(), 3U);
  EXPECT_DOUBLE_EQ(spec.time_ratios[2], 0.5);
}

TEST(SplitSpec, RegionsAsRowsAndColumns) {
  const SplitSpec spec = parseSplitSpec("2x5s");
  ASSERT_TRUE(spec.space);
  EXPECT_EQ(spec.space->rows, 2U);
  EXPECT_EQ(spec.space->columns, 5U);
  EXPECT_TRUE(spec.time_ratios.empty());
}

TEST(SplitSpec, ANumberOfRegionsIsFactorisedMostSquare) {
  const auto shape = [](const std::string& text) {
    const SplitSpec spec = parseSplitSpec(text);
    return std::to_string(spec.space->rows) + "x" + std::to_string(spec.space->columns);
  };
  EXPECT_EQ(shape("4s"), "2x2");
  EXPECT_EQ(shape("8s"), "2x4");
  EXPECT_EQ(shape("12s"), "3x4");
  EXPECT_EQ(shape("7s"), "1x7");
  EXPECT_EQ(shape("1s"), "1x1");
}

TEST(SplitSpec, SpaceAndTimeTogether) {
  const SplitSpec spec = parseSplitSpec("2x2s4t");
  EXPECT_EQ(spec.space->rows, 2U);
  EXPECT_EQ(spec.time_ratios.size(), 4U);
  EXPECT_EQ(parseSplitSpec("4s4t").space->columns, 2U);
  EXPECT_EQ(parseSplitSpec("4st(0.5,0.5)").time_ratios.size(), 2U);
}

struct Bad {
  std::string text;
  std::string quoted;
};
class BadSplitSpec : public testing::TestWithParam<Bad> {};

TEST_P(BadSplitSpec, QuotesTheOffendingPartAndShowsTheGrammar) {
  try {
    parseSplitSpec(GetParam().text);
    FAIL() << "accepted " << GetParam().text;
  } catch (const SplitSpecError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("'" + GetParam().quoted + "'"), std::string::npos) << message;
    EXPECT_NE(message.find("none | auto | [space][time]"), std::string::npos) << message;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Texts, BadSplitSpec,
    testing::Values(Bad{"", ""}, Bad{"0t", "0"}, Bad{"4", "4"}, Bad{"t4", "t4"}, Bad{"4t4t", "4t"},
                    Bad{"4t2s", "2s"}, Bad{"2x2", "2x2"}, Bad{"2x0s", "0"}, Bad{"x2s", "x2s"},
                    Bad{"4s4", "4"}, Bad{"t(0.5,0.6)", "t(0.5,0.6)"}, Bad{"t(1,0)", "0"},
                    Bad{"t(-0.5,1.5)", "-0.5"}, Bad{"t(0.5,a)", "a"}, Bad{"t(0.5,0.5", "t(0.5,0.5"},
                    Bad{"t()", ""}, Bad{"99999t", "99999"}, Bad{"4T", "4T"}, Bad{"4t ", " "},
                    Bad{"t(nan,1)", "nan"}, Bad{"t(0x1,0)", "0x1"}));

}  // namespace
}  // namespace split_mapf
