// Every refusal carries evidence; here it is checked without knowledge of how it was found.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "split_mapf/solvability/solvability.h"
#include "support/solvability_cases.h"

namespace split_mapf {
namespace {

using Vertices = std::vector<Vertex>;

class Evidence {
 public:
  Evidence(const test::SolvabilityCase& sample, const Vertices& goals,
           const SolvabilityVerdict& verdict)
      : graph_(sample.graph), starts_(sample.starts), goals_(goals), verdict_(verdict) {}

  void expectSound() const {
    const Vertices part = reachableWithout(starts_[verdict_.robots.at(0)], kNoVertex, kNoVertex);
    EXPECT_EQ(verdict_.cells, part.size());
    const auto robots =
        std::count_if(starts_.begin(), starts_.end(), [&](Vertex v) { return contains(part, v); });
    EXPECT_EQ(verdict_.blanks, part.size() - static_cast<std::size_t>(robots));
    if (verdict_.blanks_needed) {
      EXPECT_LT(verdict_.blanks, *verdict_.blanks_needed);
    }
    std::vector<std::uint32_t> distinct = verdict_.robots;
    std::sort(distinct.begin(), distinct.end());
    EXPECT_EQ(std::unique(distinct.begin(), distinct.end()), distinct.end());
    switch (verdict_.refusal) {
      case RefusalKind::kNone:
        ADD_FAILURE() << "a refusal without a reason";
        break;
      case RefusalKind::kDifferentComponents:
        for (const std::uint32_t robot : verdict_.robots) {
          const Vertices own = reachableWithout(starts_[robot], kNoVertex, kNoVertex);
          EXPECT_FALSE(contains(own, goals_[robot]));
        }
        break;
      case RefusalKind::kCycleOrder:
        expectCycle();
        expectOppositeOrderOf(3);
        break;
      case RefusalKind::kPathOrder:
        EXPECT_FALSE(verdict_.blanks_needed);
        expectWay();
        EXPECT_EQ(verdict_.vertices.size(), part.size());
        expectOppositeOrderOf(2);
        break;
      case RefusalKind::kNoBlankBridge:
        expectBridgeCrossedBothWays();
        break;
      case RefusalKind::kParity:
        EXPECT_EQ(verdict_.blanks, 0U);
        EXPECT_EQ(isOddOnVertices(), true);
        break;
      case RefusalKind::kClassMismatch:
        EXPECT_TRUE(verdict_.blanks_needed);
        EXPECT_EQ(verdict_.robots.size(), 2U);
        expectPassage();
        break;
    }
  }

 private:
  static bool contains(const Vertices& list, Vertex v) {
    return std::find(list.begin(), list.end(), v) != list.end();
  }

  /// What a walk from the vertex can reach when it may not use the edge between a and b.
  Vertices reachableWithout(Vertex from, Vertex a, Vertex b) const {
    Vertices reached = {from};
    for (std::size_t i = 0; i < reached.size(); ++i) {
      const Vertex v = reached[i];
      for (const Vertex u : graph_.neighbours(v)) {
        const bool is_removed = (v == a && u == b) || (v == b && u == a);
        if (!is_removed && !contains(reached, u)) reached.push_back(u);
      }
    }
    return reached;
  }

  void expectWay() const {
    for (std::size_t i = 0; i + 1 < verdict_.vertices.size(); ++i) {
      EXPECT_TRUE(graph_.adjacent(verdict_.vertices[i], verdict_.vertices[i + 1]));
    }
  }

  void expectCycle() const {
    expectWay();
    ASSERT_GE(verdict_.vertices.size(), 3U);
    EXPECT_TRUE(graph_.adjacent(verdict_.vertices.front(), verdict_.vertices.back()));
  }

  /// Where on the named vertices the named robots are, from the first of them onwards.
  std::vector<std::size_t> indices(const Vertices& places) const {
    const std::size_t size = verdict_.vertices.size();
    std::vector<std::size_t> result;
    for (const std::uint32_t robot : verdict_.robots) {
      const auto at = std::find(verdict_.vertices.begin(), verdict_.vertices.end(), places[robot]);
      EXPECT_NE(at, verdict_.vertices.end());
      result.push_back(static_cast<std::size_t>(at - verdict_.vertices.begin()));
    }
    if (verdict_.refusal == RefusalKind::kPathOrder) return result;
    const std::size_t first = result[0];
    for (std::size_t& index : result) index = (index + size - first) % size;
    return result;
  }

  void expectOppositeOrderOf(std::size_t robots) const {
    ASSERT_EQ(verdict_.robots.size(), robots);
    const std::vector<std::size_t> before = indices(starts_);
    const std::vector<std::size_t> after = indices(goals_);
    EXPECT_NE(before[robots - 2] < before[robots - 1], after[robots - 2] < after[robots - 1]);
  }

  void expectBridgeCrossedBothWays() const {
    EXPECT_EQ(verdict_.blanks, 0U);
    ASSERT_EQ(verdict_.vertices.size(), 2U);
    ASSERT_EQ(verdict_.robots.size(), 2U);
    const Vertex a = verdict_.vertices[0];
    const Vertex b = verdict_.vertices[1];
    EXPECT_TRUE(graph_.adjacent(a, b));
    const Vertices near = reachableWithout(a, a, b);
    EXPECT_TRUE(contains(near, starts_[verdict_.robots[0]]));
    EXPECT_FALSE(contains(near, goals_[verdict_.robots[0]]));
    EXPECT_FALSE(contains(near, starts_[verdict_.robots[1]]));
    EXPECT_TRUE(contains(near, goals_[verdict_.robots[1]]));
  }

  bool isOddOnVertices() const {
    std::map<Vertex, Vertex> goal_of;
    for (std::size_t robot = 0; robot < starts_.size(); ++robot) {
      goal_of[starts_[robot]] = goals_[robot];
    }
    std::size_t inversions = 0;
    for (const Vertex v : verdict_.vertices) {
      for (const Vertex u : verdict_.vertices) {
        inversions += v < u && goal_of[v] > goal_of[u] ? 1 : 0;
      }
    }
    return inversions % 2 == 1;
  }

  /// A way whose inner vertices lie on no other way: it must be one corridor of bridges.
  void expectPassage() const {
    expectWay();
    ASSERT_GE(verdict_.vertices.size(), 2U);
    for (std::size_t i = 0; i + 1 < verdict_.vertices.size(); ++i) {
      const Vertex a = verdict_.vertices[i];
      const Vertex b = verdict_.vertices[i + 1];
      EXPECT_FALSE(contains(reachableWithout(a, a, b), b));
      if (i > 0) {
        EXPECT_EQ(graph_.neighbours(a).size(), 2U);
      }
    }
    EXPECT_GE(graph_.neighbours(verdict_.vertices.front()).size(), 3U);
    const auto length = static_cast<std::uint32_t>(verdict_.vertices.size()) - 1;
    EXPECT_GE(*verdict_.blanks_needed, length);
    EXPECT_LE(*verdict_.blanks_needed, length + 2);
  }

  const Graph& graph_;
  const Vertices& starts_;
  const Vertices& goals_;
  const SolvabilityVerdict& verdict_;
};

TEST(SolvabilityEvidence, EveryRefusalCanBeCheckedOnItsOwn) {
  std::map<RefusalKind, int> kinds;
  for (std::uint64_t seed = 0; seed < 6000; ++seed) {
    const test::SolvabilityCase sample = test::solvabilityCase(seed, 4000000);
    for (const Vertices& goals : sample.goals) {
      const SolvabilityVerdict verdict = checkSolvable(sample.graph, sample.starts, goals);
      if (verdict.answer == Solvability::kSolvable) continue;
      ++kinds[verdict.refusal];
      Evidence(sample, goals, verdict).expectSound();
      ASSERT_FALSE(HasFailure()) << "seed " << seed << ": " << explain(verdict)
                                 << test::describe(sample.graph, sample.starts, goals);
    }
  }
  EXPECT_EQ(kinds.size(), 6U);
  for (const auto& [kind, count] : kinds) EXPECT_GT(count, 20) << static_cast<int>(kind);
}

}  // namespace
}  // namespace split_mapf
