#include "split_mapf/core/grid.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/core/grid_parts.h"
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

/// Five vertices on a map of 10x10 cells, in a ring but for one edge.
Grid planningGraph() { return Grid(10, 10, {0, 4, 40, 44, 99}, {{0, 1}, {1, 3}, {3, 2}, {3, 4}}); }

TEST(Grid, APlanningGraphKeepsItsCellsAndEdges) {
  const Grid grid = planningGraph();
  ASSERT_EQ(grid.size(), 5U);
  EXPECT_FALSE(grid.hasUnitMoves());
  EXPECT_EQ(grid.longestMove(), 10U);  // from (4,4) to (9,9)
  EXPECT_EQ(grid.cellOf(3), (Cell{4, 4}));
  EXPECT_EQ(grid.vertexAt({0, 4}), 2U);
  EXPECT_FALSE(grid.isFree({1, 0}));
  EXPECT_TRUE(grid.graph().adjacent(2, 3));
  EXPECT_FALSE(grid.graph().adjacent(0, 2));
}

TEST(Grid, StepsOfAPlanningGraphLeadAlongItsEdges) {
  const Grid grid = planningGraph();
  EXPECT_TRUE(grid.isStep({0, 0}, {4, 0}));
  EXPECT_TRUE(grid.isStep({0, 0}, {0, 0}));
  EXPECT_FALSE(grid.isStep({0, 0}, {0, 4}));
  EXPECT_FALSE(grid.isStep({0, 0}, {1, 0}));
  const auto cells = gridFromAscii({"..", ".."});
  EXPECT_TRUE(cells->hasUnitMoves());
  EXPECT_EQ(cells->longestMove(), 1U);
  EXPECT_TRUE(cells->isStep({0, 0}, {1, 0}));
  EXPECT_FALSE(cells->isStep({0, 0}, {1, 1}));
}

TEST(Grid, PartsOfAPlanningGraphHangTogetherByItsEdges) {
  // Cells 0 and 1 touch, but only 0 and 99 are joined.
  const Grid grid(10, 10, {0, 1, 99}, {{0, 2}});
  const GridParts parts(grid);
  EXPECT_EQ(parts.partOf(0), parts.partOf(2));
  EXPECT_NE(parts.partOf(0), parts.partOf(1));
  EXPECT_EQ(parts.sizeOf(parts.partOf(0)), 2U);
  EXPECT_EQ(parts.sizeOf(parts.partOf(1)), 1U);
}

TEST(Grid, RefusesAPlanningGraphWhoseCellsAreOutOfOrder) {
  using Cells = std::vector<std::uint32_t>;
  using Edges = std::vector<std::pair<Vertex, Vertex>>;
  EXPECT_THROW(Grid(10, 10, Cells{4, 0}, Edges{}), InputError);
  EXPECT_THROW(Grid(10, 10, Cells{4, 4}, Edges{}), InputError);
  EXPECT_THROW(Grid(10, 10, Cells{100}, Edges{}), InputError);
  EXPECT_THROW(Grid(0, 10, Cells{}, Edges{}), InputError);
  const Edges endless = {{0, 2}};
  EXPECT_THROW(Grid(10, 10, Cells{0, 4}, endless), std::out_of_range);
}

}  // namespace
}  // namespace split_mapf
