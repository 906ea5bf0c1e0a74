#include "split_mapf/core/grid.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "split_mapf/core/error.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

using test::gridFromAscii;

std::string refusalOf(std::uint32_t width, std::uint32_t height, std::size_t cells) {
  try {
    Grid(width, height, std::vector<bool>(cells, true));
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Grid, PacksFreeCellsInRowMajorOrder) {
  const auto grid = gridFromAscii({".#.",  //
                                   "#..",  //
                                   "..#"});
  ASSERT_EQ(grid->size(), 6U);
  const std::vector<Cell> expected = {{0, 0}, {2, 0}, {1, 1}, {2, 1}, {0, 2}, {1, 2}};
  for (Vertex v = 0; v < grid->size(); ++v) {
    EXPECT_EQ(grid->cellOf(v), expected[v]);
    EXPECT_EQ(grid->vertexAt(expected[v]), v);
  }
}

TEST(Grid, JoinsFreeNeighboursAndNothingElse) {
  const auto grid = gridFromAscii({"..#.",  //
                                   "#...",  //
                                   "...."});
  for (Vertex a = 0; a < grid->size(); ++a) {
    for (Vertex b = 0; b < grid->size(); ++b) {
      const Cell p = grid->cellOf(a);
      const Cell q = grid->cellOf(b);
      const bool beside = std::abs(p.x - q.x) + std::abs(p.y - q.y) == 1;
      EXPECT_EQ(grid->graph().adjacent(a, b), beside) << toString(p) << " " << toString(q);
    }
  }
}

TEST(Grid, DoesNotWrapRowsAround) {
  const auto grid = gridFromAscii({"...",  //
                                   "..."});
  EXPECT_FALSE(grid->graph().adjacent(grid->vertexAt({2, 0}), grid->vertexAt({0, 1})));
}

TEST(Grid, KnowsWhatIsOutsideAndWhatIsBlocked) {
  const auto grid = gridFromAscii({".#"});
  EXPECT_TRUE(grid->contains({1, 0}));
  EXPECT_FALSE(grid->isFree({1, 0}));
  EXPECT_TRUE(grid->isFree({0, 0}));
  for (const Cell outside : {Cell{-1, 0}, Cell{2, 0}, Cell{0, -1}, Cell{0, 1}}) {
    EXPECT_FALSE(grid->contains(outside));
    EXPECT_EQ(grid->vertexAt(outside), kNoVertex);
  }
}

TEST(Grid, NamesACellAsColumnThenRow) { EXPECT_EQ(toString(Cell{3, -7}), "(3,-7)"); }

TEST(Grid, RefusesImpossibleShapes) {
  EXPECT_NE(refusalOf(0, 3, 0).find("0x3"), std::string::npos);
  EXPECT_NE(refusalOf(32769, 1, 32769).find("32768"), std::string::npos);
  EXPECT_NE(refusalOf(3, 2, 5).find("needs 6 cells, got 5"), std::string::npos);
  EXPECT_EQ(refusalOf(32768, 1, 32768), "");
}

TEST(Grid, MayBeBlockedEverywhere) { EXPECT_EQ(gridFromAscii({"##", "##"})->size(), 0U); }

}  // namespace
}  // namespace split_mapf
