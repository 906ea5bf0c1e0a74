#include "search/safe_interval_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>
#include <vector>

#include "split_mapf/core/instance.h"
#include "split_mapf/core/random.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kRobot = 99;
constexpr std::uint32_t kHorizon = 40;  // beyond it nothing changes in these cases

/// A random case: other robots that walk about, and constraints.
struct Case {
  std::shared_ptr<const Grid> grid;
  Vertex start = 0;
  Vertex goal = 0;
  std::vector<Path> others;
  RobotConstraints constraints;
};

std::shared_ptr<const Grid> randomGrid(RandomEngine& engine) {
  std::vector<bool> free(20);
  for (std::size_t i = 0; i < free.size(); ++i) free[i] = drawBelow(engine, 5) > 0;
  free[0] = free[1] = true;
  return std::make_shared<const Grid>(5, 4, free);
}

Case randomCase(std::uint64_t seed) {
  RandomEngine engine(seed);
  Case c;
  c.grid = randomGrid(engine);
  const std::uint32_t cells = c.grid->size();
  c.start = static_cast<Vertex>(drawBelow(engine, cells));
  c.goal = static_cast<Vertex>(drawBelow(engine, cells));
  for (std::uint64_t i = drawBelow(engine, 4); i > 0; --i) {
    Path path = {static_cast<Vertex>(drawBelow(engine, cells))};
    for (std::uint64_t steps = drawBelow(engine, 12); steps > 0; --steps) {
      const VertexRange around = c.grid->graph().neighbours(path.back());
      const std::uint64_t pick = drawBelow(engine, around.size() + 1);
      path.push_back(pick == around.size() ? path.back() : around.begin()[pick]);
    }
    c.others.push_back(path);
  }
  for (std::uint64_t i = drawBelow(engine, 3); i > 0; --i) {
    const auto begin = static_cast<std::uint32_t>(drawBelow(engine, 8));
    const bool forever = drawBelow(engine, 4) == 0;
    c.constraints.vertex_bans.push_back(
        {static_cast<Vertex>(drawBelow(engine, cells)), begin, forever ? kForever : begin + 2});
  }
  for (std::uint64_t i = drawBelow(engine, 3); i > 0; --i) {
    const auto from = static_cast<Vertex>(drawBelow(engine, cells));
    const VertexRange around = c.grid->graph().neighbours(from);
    if (around.size() == 0) continue;
    c.constraints.move_bans.push_back({from, around.begin()[drawBelow(engine, around.size())],
                                       static_cast<std::uint32_t>(1 + drawBelow(engine, 6))});
  }
  if (drawBelow(engine, 3) == 0) {
    c.constraints.earliest_arrival = static_cast<std::uint32_t>(drawBelow(engine, 10));
  }
  return c;
}

std::uint32_t occupants(const Case& c, Vertex v, std::uint32_t t) {
  return static_cast<std::uint32_t>(std::count_if(
      c.others.begin(), c.others.end(), [&](const Path& p) { return positionAt(p, t) == v; }));
}

bool swapsWithOther(const Case& c, Vertex from, Vertex to, std::uint32_t t) {
  return from != to && std::any_of(c.others.begin(), c.others.end(), [&](const Path& p) {
           return positionAt(p, t - 1) == to && positionAt(p, t) == from;
         });
}

bool allowedAt(const Case& c, Vertex v, std::uint32_t t) {
  return std::none_of(c.constraints.vertex_bans.begin(), c.constraints.vertex_bans.end(),
                      [&](const RobotConstraints::VertexBan& ban) {
                        return ban.vertex == v && ban.begin <= t && t < ban.end;
                      });
}

/// The earliest arrival by plain search over all (vertex, step) pairs.
std::optional<std::uint32_t> earliestArrival(const Case& c, bool others_are_obstacles) {
  const auto open = [&](Vertex v, std::uint32_t t) {
    return allowedAt(c, v, t) && (!others_are_obstacles || occupants(c, v, t) == 0);
  };
  const auto holds = [&](std::uint32_t t) {
    for (std::uint32_t later = t; later <= kHorizon; ++later) {
      if (!open(c.goal, later)) return false;
    }
    return t >= c.constraints.earliest_arrival;
  };
  std::set<Vertex> now;
  if (open(c.start, 0)) now.insert(c.start);
  if (c.start == c.goal && !now.empty() && holds(0)) return 0;
  for (std::uint32_t t = 1; t <= kHorizon; ++t) {
    std::set<Vertex> next;
    bool arrived = false;
    for (const Vertex v : now) {
      if (open(v, t)) next.insert(v);
      for (const Vertex u : c.grid->graph().neighbours(v)) {
        if (!open(u, t) || c.constraints.bansMove(v, u, t)) continue;
        if (others_are_obstacles && swapsWithOther(c, v, u, t)) continue;
        next.insert(u);
        if (u == c.goal && holds(t)) arrived = true;
      }
    }
    if (arrived) return t;
    now = std::move(next);
  }
  return std::nullopt;
}

std::uint32_t collisions(const Case& c, const Path& path) {
  std::uint32_t count = 0;
  for (std::uint32_t t = 0; t <= kHorizon; ++t) {
    if (occupants(c, positionAt(path, t), t) > 0) ++count;
    if (t > 0 && swapsWithOther(c, positionAt(path, t - 1), positionAt(path, t), t)) ++count;
  }
  return count;
}

void expectLegal(const Case& c, const Path& path) {
  ASSERT_EQ(path.front(), c.start);
  ASSERT_EQ(path.back(), c.goal);
  EXPECT_GE(costOf(path), c.constraints.earliest_arrival);
  for (std::uint32_t t = 0; t <= kHorizon; ++t) {
    EXPECT_TRUE(allowedAt(c, positionAt(path, t), t)) << "step " << t;
    if (t == 0 || positionAt(path, t) == positionAt(path, t - 1)) continue;
    EXPECT_TRUE(c.grid->graph().adjacent(positionAt(path, t - 1), positionAt(path, t)));
    EXPECT_FALSE(c.constraints.bansMove(positionAt(path, t - 1), positionAt(path, t), t));
  }
}

class RandomCases : public testing::Test {
 protected:
  Path search(const Case& c, OthersAre mode, std::uint32_t latest = kForever - 1) {
    PathTable table(c.grid->size());
    for (std::uint32_t i = 0; i < c.others.size(); ++i) {
      Plan trimmed{{c.others[i]}};
      trimToArrival(trimmed);
      table.insert(i, trimmed.paths[0]);
    }
    const DistanceTable distances(c.grid->graph(), c.goal);
    SafeIntervalSearch searcher(c.grid->graph());
    SearchQuery query;
    query.robot = kRobot;
    query.start = c.start;
    query.distances = &distances;
    query.others = &table;
    query.mode = mode;
    query.constraints = &c.constraints;
    query.latest_arrival = latest;
    return searcher.search(query, Deadline()).path;
  }
};

TEST_F(RandomCases, EarliestArrivalUnderConstraintsAlone) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Case c = randomCase(seed);
    const Path path = search(c, OthersAre::kIgnored);
    const auto expected = earliestArrival(c, false);
    ASSERT_EQ(!path.empty(), expected.has_value());
    if (path.empty()) continue;
    ++found;
    expectLegal(c, path);
    EXPECT_EQ(path.size() - 1, *expected);
  }
  EXPECT_GT(found, 1000);
}

TEST_F(RandomCases, CountedCollisionsAreAvoidedWhereThatIsPossible) {
  int free = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Case c = randomCase(seed);
    const std::uint32_t latest = 20;
    const Path path = search(c, OthersAre::kCounted, latest);
    const auto alone = earliestArrival(c, false);
    ASSERT_EQ(!path.empty(), alone.has_value() && *alone <= latest);
    if (path.empty()) continue;
    expectLegal(c, path);
    EXPECT_LE(path.size() - 1, latest);
    const auto avoiding = earliestArrival(c, true);
    if (!avoiding || *avoiding > latest) continue;
    ++free;
    EXPECT_EQ(collisions(c, path), 0U);
    EXPECT_EQ(path.size() - 1, *avoiding) << "among free paths the earliest arrival";
  }
  EXPECT_GT(free, 500);
}

TEST(SafeIntervalSearch, AnExpiredDeadlineInterruptsALongSearch) {
  const auto grid = test::serpentineGrid(100);
  const DistanceTable distances(grid->graph(), grid->size() - 1);
  PathTable table(grid->size());
  SafeIntervalSearch searcher(grid->graph());
  SearchQuery query;
  query.start = 0;
  query.distances = &distances;
  query.others = &table;
  EXPECT_TRUE(searcher.search(query, Deadline(0)).interrupted);
  EXPECT_FALSE(searcher.search(query, Deadline()).path.empty()) << "and can be used again";
}

}  // namespace
}  // namespace split_mapf
