#include "split_mapf/roadmap/proof.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "split_mapf/core/random.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kSide = 100;

ObstacleRaster openMap() {
  return rasterOf(kSide, kSide, std::vector<bool>(std::size_t{kSide} * kSide, true), 0.1);
}

/// A graph for discs of 0.5 m, five cells, on the open map: cells in ascending order.
Roadmap graphOf(const std::vector<Cell>& cells,
                const std::vector<std::pair<Vertex, Vertex>>& edges) {
  Roadmap roadmap;
  roadmap.width = roadmap.height = kSide;
  roadmap.resolution_m = 0.1;
  roadmap.robot_radius_m = 0.5;
  roadmap.spacing_cells = 15;
  for (const Cell cell : cells) {
    roadmap.cells.push_back(static_cast<std::uint32_t>(cell.y) * kSide +
                            static_cast<std::uint32_t>(cell.x));
  }
  roadmap.edges = edges;
  return roadmap;
}

TEST(Proof, AcceptsALatticeOfTheLeastSpacingAndNoTighterOne) {
  // Round a right angle a follower comes as near as spacing / sqrt(2): 14 cells are too few for 10.
  EXPECT_EQ(findUnsafe(openMap(), graphOf({{20, 20}, {35, 20}, {20, 35}}, {{0, 1}, {0, 2}})),
            std::nullopt);
  const auto fault =
      findUnsafe(openMap(), graphOf({{20, 20}, {34, 20}, {20, 34}}, {{0, 1}, {0, 2}}));
  ASSERT_TRUE(fault.has_value());
  EXPECT_NE(fault->find("(20,20)"), std::string::npos) << *fault;
  EXPECT_NE(fault->find("1 m are needed"), std::string::npos) << *fault;
}

TEST(Proof, FindsTwoVerticesThatAreTooNear) {
  EXPECT_EQ(findUnsafe(openMap(), graphOf({{20, 20}, {30, 20}}, {})), std::nullopt);
  EXPECT_TRUE(findUnsafe(openMap(), graphOf({{20, 20}, {29, 20}}, {})).has_value());
}

TEST(Proof, FindsAVertexTooNearToAnEdge) {
  EXPECT_EQ(findUnsafe(openMap(), graphOf({{30, 20}, {20, 30}, {40, 30}}, {{1, 2}})), std::nullopt);
  EXPECT_TRUE(findUnsafe(openMap(), graphOf({{30, 21}, {20, 30}, {40, 30}}, {{1, 2}})).has_value());
}

TEST(Proof, FindsEdgesThatCross) {
  const std::vector<Cell> cells = {{30, 20}, {20, 30}, {40, 30}, {30, 40}};
  EXPECT_EQ(findUnsafe(openMap(), graphOf(cells, {})), std::nullopt);
  EXPECT_TRUE(findUnsafe(openMap(), graphOf(cells, {{0, 3}, {1, 2}})).has_value());
}

TEST(Proof, FindsEdgesThatAreTooNearOnlyInOneDirection) {
  // Side by side, shifted against each other: towards each other the robots meet at the overlap.
  const std::vector<Cell> cells = {{20, 20}, {38, 20}, {20, 31}, {38, 31}};
  EXPECT_EQ(findUnsafe(openMap(), graphOf(cells, {{0, 1}, {2, 3}})), std::nullopt);
  const std::vector<Cell> near = {{20, 20}, {38, 20}, {29, 29}, {47, 29}};
  EXPECT_TRUE(findUnsafe(openMap(), graphOf(near, {{0, 1}, {2, 3}})).has_value());
}

TEST(Proof, FindsAnObstacleBesideAnEdgeAndTheBorder) {
  ObstacleRaster map = openMap();
  map.blocked[map.indexOf({30, 26})] = 1;  // its square begins 5.5 cells below row 20
  const Roadmap graph = graphOf({{20, 20}, {40, 20}}, {{0, 1}});
  EXPECT_EQ(findUnsafe(map, graph), std::nullopt);
  map.blocked[map.indexOf({30, 25})] = 1;  // 4.5 cells
  const auto fault = findUnsafe(map, graph);
  ASSERT_TRUE(fault.has_value());
  EXPECT_NE(fault->find("the obstacle at (30,25)"), std::string::npos) << *fault;
  EXPECT_EQ(findUnsafe(openMap(), graphOf({{5, 20}}, {})), std::nullopt);
  EXPECT_TRUE(findUnsafe(openMap(), graphOf({{4, 20}}, {})).has_value());
}

TEST(Proof, FindsShapesThatAreNoGraph) {
  EXPECT_TRUE(findUnsafe(openMap(), graphOf({{40, 20}, {20, 20}}, {})).has_value());
  EXPECT_TRUE(findUnsafe(openMap(), graphOf({{20, 20}, {40, 20}}, {{1, 0}})).has_value());
  EXPECT_TRUE(findUnsafe(openMap(), graphOf({{20, 20}, {40, 20}}, {{0, 2}})).has_value());
}

TEST(Proof, FindsEveryVertexOfALatticeThatIsMovedTooFar) {
  std::vector<Cell> cells;
  std::vector<std::pair<Vertex, Vertex>> edges;
  for (std::int32_t y = 0; y < 5; ++y) {
    for (std::int32_t x = 0; x < 5; ++x) {
      const auto v = static_cast<Vertex>(cells.size());
      cells.push_back({10 + 15 * x, 10 + 15 * y});
      if (x < 4) edges.emplace_back(v, v + 1);
      if (y < 4) edges.emplace_back(v, v + 5);
    }
  }
  ASSERT_EQ(findUnsafe(openMap(), graphOf(cells, edges)), std::nullopt);
  for (std::size_t v = 0; v < cells.size(); ++v) {
    std::vector<Cell> moved = cells;
    moved[v].x += v % 5 == 4 ? -6 : 6;
    EXPECT_TRUE(findUnsafe(openMap(), graphOf(moved, edges)).has_value()) << "vertex " << v;
  }
}

}  // namespace
}  // namespace split_mapf
