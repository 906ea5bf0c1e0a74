#include "split_mapf/core/graph.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace split_mapf {
namespace {

std::vector<Vertex> listOf(VertexRange range) { return {range.begin(), range.end()}; }

TEST(Graph, ListsNeighboursInAscendingOrderWhateverTheOrderOfEdges) {
  const Graph graph(4, {{3, 1}, {0, 1}, {2, 1}});
  EXPECT_EQ(listOf(graph.neighbours(1)), (std::vector<Vertex>{0, 2, 3}));
  EXPECT_EQ(listOf(graph.neighbours(3)), (std::vector<Vertex>{1}));
  EXPECT_EQ(graph.edgeCount(), 3U);
}

TEST(Graph, DropsLoopsAndParallelEdges) {
  const Graph graph(2, {{0, 1}, {1, 0}, {0, 0}, {0, 1}});
  EXPECT_EQ(graph.edgeCount(), 1U);
  EXPECT_EQ(listOf(graph.neighbours(0)), (std::vector<Vertex>{1}));
}

TEST(Graph, KnowsAdjacencyInBothDirectionsOnly) {
  const Graph graph(3, {{0, 1}, {1, 2}});
  EXPECT_TRUE(graph.adjacent(0, 1));
  EXPECT_TRUE(graph.adjacent(1, 0));
  EXPECT_FALSE(graph.adjacent(0, 2));
  EXPECT_FALSE(graph.adjacent(0, 0));
}

TEST(Graph, RefusesAnEdgeToNowhere) {
  EXPECT_THROW(Graph(2, {{0, 2}}), std::out_of_range);
  EXPECT_THROW(Graph(0, {{0, 0}}), std::out_of_range);
}

TEST(Graph, KeepsRowsOfFourWhileNoVertexHasMore) {
  const Graph star(6, {{0, 1}, {2, 0}, {0, 3}, {4, 0}});
  ASSERT_NE(star.rowsOfFour(), nullptr);
  const std::vector<Vertex> rows(star.rowsOfFour(), star.rowsOfFour() + 24);
  EXPECT_EQ(rows, (std::vector<Vertex>{1, 2, 3, 4, 0, 1, 1, 1, 0, 2, 2, 2,  //
                                       0, 3, 3, 3, 0, 4, 4, 4, 5, 5, 5, 5}));
  EXPECT_EQ(Graph(6, {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {0, 5}}).rowsOfFour(), nullptr);
}

TEST(Graph, MayBeEmpty) {
  EXPECT_EQ(Graph().size(), 0U);
  EXPECT_EQ(Graph(0, {}).size(), 0U);
  EXPECT_EQ(Graph(3, {}).neighbours(2).size(), 0U);
}

}  // namespace
}  // namespace split_mapf
