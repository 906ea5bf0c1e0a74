#include "solvability/bridge_structure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "support/solvability_cases.h"

namespace split_mapf {
namespace {

/// Whether `to` can be reached from `from` without the edge between a and b.
bool isConnected(const Graph& graph, Vertex from, Vertex to, std::pair<Vertex, Vertex> removed) {
  std::set<Vertex> seen = {from};
  std::vector<Vertex> open = {from};
  while (!open.empty()) {
    const Vertex v = open.back();
    open.pop_back();
    for (const Vertex u : graph.neighbours(v)) {
      if (std::minmax(v, u) == std::minmax(removed.first, removed.second)) continue;
      if (seen.insert(u).second) open.push_back(u);
    }
  }
  return seen.count(to) > 0;
}

/// Whether the two share a loop, by the definition.
bool shareLoop(const Graph& graph, Vertex a, Vertex b) {
  for (Vertex v = 0; v < graph.size(); ++v) {
    for (const Vertex u : graph.neighbours(v)) {
      if (!isConnected(graph, a, b, {v, u})) return false;
    }
  }
  return isConnected(graph, a, b, {kNoVertex, kNoVertex});
}

bool hasEvenCycle(const Graph& graph, std::vector<Vertex>& path) {
  const std::size_t length = path.size();
  if (length >= 4 && length % 2 == 0 && graph.adjacent(path.back(), path.front())) return true;
  for (const Vertex v : graph.neighbours(path.back())) {
    if (std::find(path.begin(), path.end(), v) != path.end()) continue;
    path.push_back(v);
    const bool found = hasEvenCycle(graph, path);
    path.pop_back();
    if (found) return true;
  }
  return false;
}

TEST(BridgeStructure, LoopsAndPartsFollowTheirDefinition) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const Graph graph = test::solvabilityCase(seed, 10000).graph;
    const BridgeStructure structure(graph);
    for (Vertex a = 0; a < graph.size(); ++a) {
      for (Vertex b = 0; b < a; ++b) {
        const bool same_loop = structure.loopOf(a) != BridgeStructure::kNoLoop &&
                               structure.loopOf(a) == structure.loopOf(b);
        ASSERT_EQ(same_loop, shareLoop(graph, a, b)) << "seed " << seed;
        ASSERT_EQ(structure.partOf(a) == structure.partOf(b),
                  isConnected(graph, a, b, {kNoVertex, kNoVertex}))
            << "seed " << seed;
      }
    }
  }
}

TEST(BridgeStructure, EvenCyclesAreFound) {
  int without = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const Graph graph = test::solvabilityCase(seed, 10000).graph;
    const BridgeStructure structure(graph);
    std::vector<bool> expected(structure.loops().size(), false);
    for (Vertex v = 0; v < graph.size(); ++v) {
      std::vector<Vertex> path = {v};
      if (structure.loopOf(v) == BridgeStructure::kNoLoop) continue;
      if (hasEvenCycle(graph, path)) expected[structure.loopOf(v)] = true;
    }
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_EQ(structure.loops()[i].has_even_cycle, expected[i]) << "seed " << seed;
      without += expected[i] ? 0 : 1;
    }
  }
  EXPECT_GT(without, 100);
}

TEST(BridgeStructure, CountsTheBlanksThatAreAlwaysEnough) {
  const auto enough = [](const Graph& graph) {
    return BridgeStructure(graph).parts()[0].enough_blanks;
  };
  constexpr std::uint32_t kNever = 0xffffffffU;
  EXPECT_EQ(enough(Graph(3, {{0, 1}, {1, 2}})), kNever) << "a path";
  EXPECT_EQ(enough(Graph(3, {{0, 1}, {1, 2}, {2, 0}})), kNever) << "a ring";
  EXPECT_EQ(enough(Graph(4, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}})), 1U) << "a loop";
  EXPECT_EQ(enough(Graph(5, {{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 4}})), 2U) << "a loop's dead end";
  EXPECT_EQ(enough(Graph(4, {{0, 1}, {0, 2}, {0, 3}})), 2U) << "a star";
  EXPECT_EQ(enough(Graph(5, {{0, 1}, {0, 2}, {0, 3}, {3, 4}})), 3U) << "a junction's dead end";
  EXPECT_EQ(enough(Graph(7, {{0, 1}, {0, 2}, {0, 3}, {3, 4}, {4, 5}, {4, 6}})), 4U)
      << "two junctions, two edges apart";
}

}  // namespace
}  // namespace split_mapf
