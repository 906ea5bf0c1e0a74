#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "split_mapf/core/graph.h"
#include "split_mapf/core/random.h"

namespace split_mapf::test {

/// A small graph, where robots start on it, and several wishes where they should go.
struct SolvabilityCase {
  std::string family;
  Graph graph;
  std::vector<Vertex> starts;
  std::vector<std::vector<Vertex>> goals;
};

/// A random case of 3 to 10 vertices and at most `most_arrangements` arrangements: trees, paths,
/// cycles, thetas, cactuses of odd cycles, loops and junctions joined by corridors of every length,
/// grids, anything, disconnected ones too; 0 to 5 vertices empty, or just a few robots. The same
/// seed gives the same case.
SolvabilityCase solvabilityCase(std::uint64_t seed, std::uint64_t most_arrangements);

/// A connected graph of loops, junctions, corridors and dead ends of about `size` vertices.
Graph graphOfCorridors(std::uint32_t size, RandomEngine& engine);

/// Edges and places as text, for messages of failing tests.
std::string describe(const Graph& graph, const std::vector<Vertex>& starts,
                     const std::vector<Vertex>& goals);

}  // namespace split_mapf::test
