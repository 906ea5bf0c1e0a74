#include "roadmap/leg_matching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "split_mapf/core/random.h"

namespace split_mapf::roadmap {
namespace {

/// Robots in a crowd: each may go to most of few vertices, some of them as far as others to the
/// last bit.
std::vector<std::vector<LegOption>> drawCrowd(std::uint64_t seed, std::uint32_t robots) {
  RandomEngine engine(seed);
  std::vector<std::vector<LegOption>> options(robots);
  for (std::vector<LegOption>& of_robot : options) {
    const double x = static_cast<double>(drawBelow(engine, 1000000)) / 3000;
    const double y = static_cast<double>(drawBelow(engine, 1000000)) / 3000;
    for (Vertex v = 0; v < robots + 1; ++v) {
      const double dx = x - 29.0 * (v % 10);
      const Vertex row = v / 10;
      const double dy = y - 29.0 * row;
      of_robot.push_back({v, dx * dx + dy * dy, false});
    }
  }
  return options;
}

TEST(LegMatching, SumsThatRoundNoLongerGoInCircles) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto options = drawCrowd(seed, 60);
    const std::vector<Vertex> taken = matchLegs(options);
    EXPECT_EQ(std::set<Vertex>(taken.begin(), taken.end()).size(), 60U) << "seed " << seed;
    EXPECT_EQ(std::count(taken.begin(), taken.end(), kNoVertex), 0) << "seed " << seed;
  }
}

TEST(LegMatching, TakesTheLeastSumOfSquares) {
  // The nearest vertex of the first robot is the only one of the second.
  const std::vector<std::vector<LegOption>> options = {{{7, 1, false}, {9, 4, false}},
                                                       {{7, 2, false}}};
  EXPECT_EQ(matchLegs(options), (std::vector<Vertex>{9, 7}));
  const std::vector<std::vector<LegOption>> banned = {{{7, 1, false}, {9, 4, true}},
                                                      {{7, 2, false}}};
  const std::vector<Vertex> one = matchLegs(banned);
  EXPECT_EQ(std::count(one.begin(), one.end(), kNoVertex), 1);
}

}  // namespace
}  // namespace split_mapf::roadmap
