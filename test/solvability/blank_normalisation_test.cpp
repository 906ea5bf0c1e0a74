#include "solvability/blank_normalisation.h"

#include <gtest/gtest.h>

#include "support/reachability.h"
#include "support/solvability_cases.h"

namespace split_mapf {
namespace {

TEST(BlankNormalisation, ALegalSequenceOfMovesGathersTheBlanksAroundTheRoot) {
  int parts = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    const test::SolvabilityCase sample = test::solvabilityCase(seed, 3000);
    const auto root = static_cast<Vertex>(seed % sample.graph.size());
    std::vector<std::uint32_t> rank_of(sample.graph.size(), kNoVertex);
    const PartTree tree = growPartTree(sample.graph, root, rank_of);
    std::vector<std::uint32_t> robots(tree.size(), kNoRobot);
    std::uint32_t blanks = tree.size();
    for (std::uint32_t robot = 0; robot < sample.starts.size(); ++robot) {
      if (rank_of[sample.starts[robot]] == kNoVertex) continue;
      robots[rank_of[sample.starts[robot]]] = robot;
      --blanks;
    }
    const std::vector<std::uint32_t> gathered = gatherBlanks(tree, robots);
    std::vector<Vertex> places = sample.starts;
    for (std::uint32_t rank = 0; rank < tree.size(); ++rank) {
      ASSERT_EQ(gathered[rank] == kNoRobot, rank < blanks) << "seed " << seed;
      if (gathered[rank] != kNoRobot) places[gathered[rank]] = tree.vertices[rank];
    }
    const test::Reachability reachable(sample.graph, sample.starts);
    ASSERT_TRUE(reachable.reaches(places))
        << "seed " << seed << test::describe(sample.graph, sample.starts, places);
    parts += blanks > 0 ? 1 : 0;
  }
  EXPECT_GT(parts, 500);
}

}  // namespace
}  // namespace split_mapf
