#include "split_mapf/split/decomposition.h"

#include <gtest/gtest.h>

#include "split_mapf/core/validate.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

class Stitching : public testing::Test {
 protected:
  Decomposition leaf(const std::vector<Vertex>& from, const std::vector<Vertex>& to,
                     std::vector<std::uint32_t> robots) {
    return Decomposition::leaf(Instance::fromVertices(grid_, from, to), std::move(robots));
  }
  std::shared_ptr<const Grid> grid_ = test::gridFromAscii({"......"});
};

TEST_F(Stitching, SequencesBeginWhenTheSlowestHasArrived) {
  const Decomposition tree =
      Decomposition::sequence({leaf({0, 3}, {2, 4}, {0, 1}), leaf({2, 4}, {3, 5}, {0, 1})});
  const Plan plan = stitch(tree, {{{{0, 1, 2}, {3, 4}}}, {{{2, 3}, {4, 5}}}}, 2);
  EXPECT_EQ(plan.paths[0], (Path{0, 1, 2, 3}));
  EXPECT_EQ(plan.paths[1], (Path{3, 4, 4, 5}));
  const Instance whole = Instance::fromVertices(grid_, {0, 3}, {3, 5});
  EXPECT_TRUE(validate(whole, plan).empty());
}

TEST_F(Stitching, ParallelsRunSideBySideWithRobotsOfTheirOwn) {
  const Decomposition tree =
      Decomposition::sequence({Decomposition::parallel({leaf({4}, {5}, {1}), leaf({0}, {2}, {0})}),
                               leaf({2, 5}, {1, 4}, {0, 1})});
  const Plan plan = stitch(tree, {{{{4, 5}}}, {{{0, 1, 2}}}, {{{2, 1}, {5, 4}}}}, 2);
  EXPECT_EQ(plan.paths[0], (Path{0, 1, 2, 1}));
  EXPECT_EQ(plan.paths[1], (Path{4, 5, 5, 4}));
}

TEST_F(Stitching, PathsEndAtTheArrival) {
  const Decomposition tree =
      Decomposition::sequence({leaf({0, 5}, {1, 4}, {0, 1}), leaf({1, 4}, {1, 2}, {0, 1})});
  const Plan plan = stitch(tree, {{{{0, 1}, {5, 4}}}, {{{1}, {4, 3, 2}}}}, 2);
  EXPECT_EQ(plan.paths[0], (Path{0, 1}));
  EXPECT_EQ(plan.paths[1], (Path{5, 4, 3, 2}));
}

TEST_F(Stitching, LeavesComeFromLeftToRight) {
  const Decomposition tree =
      Decomposition::sequence({Decomposition::parallel({leaf({0}, {0}, {0}), leaf({1}, {1}, {1})}),
                               leaf({0, 1}, {0, 1}, {0, 1})});
  const auto leaves = leavesOf(tree);
  ASSERT_EQ(leaves.size(), 3U);
  EXPECT_EQ(leaves[1]->robots, (std::vector<std::uint32_t>{1}));
}

}  // namespace
}  // namespace split_mapf
