#include "roadmap/lattice.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "split_mapf/core/graph.h"
#include "split_mapf/core/random.h"

namespace split_mapf::roadmap {
namespace {

/// The sum of the squared sizes of a graph's pieces.
std::uint64_t weightOf(const CellGraph& lattice) {
  const auto size = static_cast<std::uint32_t>(lattice.cells.size());
  const Graph graph(size, {lattice.edges.begin(), lattice.edges.end()});
  std::vector<bool> seen(size, false);
  std::uint64_t weight = 0;
  for (Vertex v = 0; v < size; ++v) {
    if (seen[v]) continue;
    std::vector<Vertex> piece = {v};
    seen[v] = true;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      for (const Vertex u : graph.neighbours(piece[i])) {
        if (seen[u]) continue;
        seen[u] = true;
        piece.push_back(u);
      }
    }
    weight += std::uint64_t{piece.size()} * piece.size();
  }
  return weight;
}

TEST(Lattice, OnePassWeighsEveryOffsetAsItsOwnGraphDoes) {
  RandomEngine engine(5);
  for (int round = 0; round < 20; ++round) {
    const auto width = static_cast<std::uint32_t>(10 + drawBelow(engine, 40));
    const auto height = static_cast<std::uint32_t>(10 + drawBelow(engine, 40));
    std::vector<bool> free(std::size_t{width} * height);
    for (std::size_t i = 0; i < free.size(); ++i) free[i] = drawBelow(engine, 60) != 0;
    const ObstacleRaster raster = rasterOf(width, height, free, 1);
    const ClearSpace space(raster, 1.2, Deadline());
    const std::uint32_t step = 4;
    std::uint64_t most = 0;
    for (std::uint32_t y = 0; y < step; ++y) {
      for (std::uint32_t x = 0; x < step; ++x) {
        most = std::max(most, weightOf(latticeAt(space, step, {x, y, 0})));
      }
    }
    for (const Offset& offset : bestOffsets(space, step, 16, Deadline())) {
      ASSERT_EQ(offset.weight, weightOf(latticeAt(space, step, offset))) << "round " << round;
    }
    const std::vector<Offset> best = bestOffsets(space, step, 1, Deadline());
    ASSERT_EQ(best.empty() ? 0 : best.front().weight, most) << "round " << round;
  }
}

}  // namespace
}  // namespace split_mapf::roadmap
