#include "split_mapf/core/collision.h"

#include <gtest/gtest.h>

#include <random>

#include "support/meeting.h"

namespace split_mapf {
namespace {

TEST(Collision, KnowsAMeetingASwapAndWhatIsNone) {
  EXPECT_TRUE(movesConflict(0, 1, 2, 1));
  EXPECT_TRUE(movesConflict(0, 1, 1, 1));
  EXPECT_TRUE(movesConflict(0, 1, 1, 0));
  EXPECT_FALSE(movesConflict(0, 1, 1, 2)) << "following";
  EXPECT_FALSE(movesConflict(0, 0, 1, 2)) << "waiting beside";
}

TEST(Collision, NamesTheFirstStep) {
  EXPECT_EQ(firstConflict({3}, {3}), 0U);
  EXPECT_EQ(firstConflict({0, 1, 2}, {3, 2, 1}), 2U);
  EXPECT_EQ(firstConflict({0, 1}, {3, 2, 1}), 2U) << "one has ended where the other comes";
  EXPECT_EQ(firstConflict({0, 1, 2}, {1, 2, 3}), std::nullopt) << "following";
  EXPECT_EQ(firstConflict({0}, {1, 2}), std::nullopt);
}

TEST(Collision, AgreesWithTheDefinitionOnRandomWalks) {
  std::mt19937 random(3);
  const auto walk = [&random] {
    Path path = {static_cast<Vertex>(random() % 6)};
    for (std::uint32_t t = random() % 8; t > 0; --t) {
      const auto step = static_cast<Vertex>(random() % 3);
      path.push_back((path.back() + 5 + step) % 6);  // a ring of six
    }
    return path;
  };
  int conflicts = 0;
  for (int i = 0; i < 5000; ++i) {
    const Path a = walk();
    const Path b = walk();
    const bool expected = test::meet(a, b);
    EXPECT_EQ(firstConflict(a, b).has_value(), expected);
    EXPECT_EQ(firstConflict(a, b), firstConflict(b, a));
    conflicts += expected ? 1 : 0;
  }
  EXPECT_GT(conflicts, 500);
  EXPECT_LT(conflicts, 4500);
}

}  // namespace
}  // namespace split_mapf
