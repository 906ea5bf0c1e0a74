#include "search/heading_costs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "split_mapf/core/random.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kTurn = HeadingCosts::kTurn;

TEST(HeadingCosts, TurnsInPlace) {
  for (Heading from = 0; from < 4; ++from) {
    const HeadingCosts costs(from, 70);
    for (Heading to = 0; to < 4; ++to) {
      EXPECT_EQ(costs[to], 70 + kTurn * turnsBetween(from, to)) << int{from} << " to " << int{to};
    }
    EXPECT_EQ(costs.least(), 70U);
  }
  for (Heading to = 0; to < 4; ++to) EXPECT_EQ(HeadingCosts(kNoHeading, 70)[to], 70U);
}

TEST(HeadingCosts, SaysOfAllFourWhatItSaysOfEach) {
  RandomEngine engine(1);
  for (int draw = 0; draw < 2000; ++draw) {
    const std::uint32_t range = draw % 2 == 0 ? 4 * kTurn : HeadingCosts::kMost;
    const auto any = [&] {
      const auto heading = static_cast<Heading>(drawBelow(engine, 5));
      return HeadingCosts(heading, static_cast<std::uint32_t>(drawBelow(engine, range)));
    };
    const HeadingCosts a = any().orLess(any());
    const HeadingCosts b = any();
    const auto most = static_cast<std::uint32_t>(drawBelow(engine, range));
    const std::array<std::uint8_t, 4> left = {0, 1, 2, 1};
    for (Heading h = 0; h < 4; ++h) {
      const HeadingCosts::Headings only = HeadingCosts::only(h);
      EXPECT_EQ(HeadingCosts::firstOf(only), h);
      EXPECT_EQ(a.orLess(b)[h], std::min(a[h], b[h]));
      EXPECT_EQ((a.notBelow(b) & only) != 0, a[h] >= b[h]);
      EXPECT_EQ((a.within(most) & only) != 0, a[h] <= most);
      EXPECT_EQ((a.within(most, left) & only) != 0, a[h] + kTurn * left[h] <= most);
      EXPECT_EQ(HeadingCosts::only(h, false), 0U);
    }
    EXPECT_EQ((a.notBelow(b) | a.within(most)) & ~HeadingCosts::kAll, 0U);
  }
}

}  // namespace
}  // namespace split_mapf
