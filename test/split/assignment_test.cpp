#include "split/assignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "split_mapf/core/random.h"

namespace split_mapf {
namespace {

using Candidates = std::vector<std::vector<Candidate>>;

/// (robots assigned, least total cost) by trying everything.
std::pair<int, std::uint64_t> bruteForce(const Candidates& candidates, std::size_t robot,
                                         std::set<Vertex>& used) {
  if (robot == candidates.size()) return {0, 0};
  std::pair<int, std::uint64_t> best = bruteForce(candidates, robot + 1, used);
  for (const Candidate& candidate : candidates[robot]) {
    if (!used.insert(candidate.vertex).second) continue;
    std::pair<int, std::uint64_t> result = bruteForce(candidates, robot + 1, used);
    ++result.first;
    result.second += candidate.cost;
    if (result.first > best.first || (result.first == best.first && result.second < best.second)) {
      best = result;
    }
    used.erase(candidate.vertex);
  }
  return best;
}

TEST(Assignment, IsAsGoodAsTryingEverything) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomEngine engine(seed);
    Candidates candidates(1 + drawBelow(engine, 6));
    const std::uint64_t vertices = 3 + drawBelow(engine, 8);
    for (auto& own : candidates) {
      for (Vertex v = 0; v < vertices; ++v) {
        if (drawBelow(engine, 3) == 0) {
          own.push_back({v, static_cast<std::uint32_t>(drawBelow(engine, 20))});
        }
      }
    }
    const std::vector<Vertex> assigned = assignAtLeastCost(candidates);
    std::set<Vertex> used;
    int count = 0;
    std::uint64_t cost = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (assigned[i] == kNoVertex) continue;
      EXPECT_TRUE(used.insert(assigned[i]).second) << "two robots in one vertex";
      const auto chosen = std::find_if(candidates[i].begin(), candidates[i].end(),
                                       [&](const Candidate& c) { return c.vertex == assigned[i]; });
      ASSERT_NE(chosen, candidates[i].end()) << "not a candidate of robot " << i;
      ++count;
      cost += chosen->cost;
    }
    used.clear();
    const auto best = bruteForce(candidates, 0, used);
    EXPECT_EQ(count, best.first);
    EXPECT_EQ(cost, best.second);
  }
}

}  // namespace
}  // namespace split_mapf
