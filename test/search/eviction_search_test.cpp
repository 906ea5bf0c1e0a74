#include "search/eviction_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "split_mapf/core/random.h"
#include "support/ascii_grid.h"
#include "support/long_run.h"
#include "support/meeting.h"

namespace split_mapf {
namespace {

// Everything begins at this step in half of the cases: the searches keep 64 steps in a word.
constexpr std::uint32_t kLateBegin = 55;
constexpr std::uint32_t kHorizon = kLateBegin + 30;  // all arrive by then
constexpr std::uint32_t kNobody = 0xffffffffU;

/// A random case: robots on paths without conflicts, what it costs to evict each, and a question.
struct Case {
  std::shared_ptr<const Grid> grid;
  std::vector<Path> placed;
  std::vector<std::uint32_t> weights;
  Vertex start = 0;
  Vertex goal = 0;
  std::uint32_t departure = 0;
  std::uint32_t latest_arrival = 0;
};

Path randomWalk(const Grid& grid, RandomEngine& engine, std::uint32_t begin) {
  Path path(begin + 1, static_cast<Vertex>(drawBelow(engine, grid.size())));
  for (std::uint64_t steps = drawBelow(engine, 12); steps > 0; --steps) {
    const VertexRange around = grid.graph().neighbours(path.back());
    const std::uint64_t pick = drawBelow(engine, around.size() + 1);
    path.push_back(pick == around.size() ? path.back() : around.begin()[pick]);
  }
  path.resize(costOf(path) + 1);
  return path;
}

Case randomCase(std::uint64_t seed) {
  RandomEngine engine(seed);
  Case c;
  std::vector<bool> free(20);
  for (std::size_t i = 0; i < free.size(); ++i) free[i] = drawBelow(engine, 5) > 0;
  free[0] = free[1] = true;
  c.grid = std::make_shared<const Grid>(5, 4, free);
  const std::uint32_t begin = seed % 2 == 0 ? 0 : kLateBegin;
  for (std::uint64_t tries = drawBelow(engine, 12); tries > 0; --tries) {
    const Path path = randomWalk(*c.grid, engine, begin);
    if (std::any_of(c.placed.begin(), c.placed.end(),
                    [&](const Path& other) { return test::meet(path, other); })) {
      continue;
    }
    c.placed.push_back(path);
    c.weights.push_back(static_cast<std::uint32_t>(1 + drawBelow(engine, 9)));
  }
  c.start = static_cast<Vertex>(drawBelow(engine, c.grid->size()));
  c.goal = static_cast<Vertex>(drawBelow(engine, c.grid->size()));
  c.latest_arrival = begin + static_cast<std::uint32_t>(drawBelow(engine, kHorizon - kLateBegin));
  // Who departs early has time enough to go anywhere, or to wait for long.
  if (drawBelow(engine, 3) > 0) c.departure = begin;
  if (drawBelow(engine, 3) == 0) c.departure += static_cast<std::uint32_t>(drawBelow(engine, 6));
  return c;
}

std::uint32_t occupant(const Case& c, Vertex v, std::uint32_t t) {
  for (std::uint32_t i = 0; i < c.placed.size(); ++i) {
    if (positionAt(c.placed[i], t) == v) return i;
  }
  return kNobody;
}

/// What a step costs: whom it meets, unless that robot comes along, and whom it swaps with.
std::uint32_t stepWeight(const Case& c, Vertex from, Vertex to, std::uint32_t arrival) {
  const std::uint32_t before = occupant(c, from, arrival - 1);
  const std::uint32_t there = occupant(c, to, arrival);
  std::uint32_t weight = 0;
  if (there != kNobody && there != before) weight += c.weights[there];
  if (from == to) return weight;
  const std::uint32_t opposite = occupant(c, to, arrival - 1);
  if (opposite != kNobody && occupant(c, from, arrival) == opposite) weight += c.weights[opposite];
  return weight;
}

/// What staying for good costs: everybody who comes later.
std::uint32_t holdWeight(const Case& c, std::uint32_t arrival) {
  std::uint32_t weight = 0;
  std::uint32_t before = occupant(c, c.goal, arrival);
  for (std::uint32_t t = arrival + 1; t <= kHorizon; ++t) {
    const std::uint32_t now = occupant(c, c.goal, t);
    if (now != kNobody && now != before) weight += c.weights[now];
    before = now;
  }
  return weight;
}

using Cost = std::pair<std::uint32_t, std::uint32_t>;  // weight, arrival

/// The least cost by plain search over all (vertex, step) pairs from step `first` on.
std::optional<Cost> leastCost(const Case& c, bool may_evict, std::uint32_t first = 0) {
  std::map<Vertex, std::uint32_t> now;
  std::optional<Cost> best;
  const auto arrive = [&](std::uint32_t weight, std::uint32_t t) {
    const Cost cost{weight + holdWeight(c, t), t};
    if (!may_evict && cost.first > 0) return;
    if (!best || cost < *best) best = cost;
  };
  const std::uint32_t at_start = occupant(c, c.start, first);
  if (at_start != kNobody && !may_evict) return best;
  now[c.start] = at_start == kNobody ? 0 : c.weights[at_start];
  for (std::uint32_t t = first; t <= c.latest_arrival; ++t) {
    if (now.count(c.goal) > 0 && t >= c.departure) arrive(now[c.goal], t);
    std::map<Vertex, std::uint32_t> next;
    const auto reach = [&](Vertex v, std::uint32_t weight) {
      if (!may_evict && weight > 0) return;
      const auto known = next.find(v);
      if (known == next.end() || weight < known->second) next[v] = weight;
    };
    for (const auto& [v, weight] : now) {
      reach(v, weight + stepWeight(c, v, v, t + 1));
      if (t < c.departure) continue;
      for (const Vertex u : c.grid->graph().neighbours(v)) {
        reach(u, weight + stepWeight(c, v, u, t + 1));
      }
    }
    now = std::move(next);
  }
  return best;
}

Cost costInCase(const Case& c, const Path& path) {
  const std::uint32_t at_start = occupant(c, path.front(), 0);
  std::uint32_t weight = at_start == kNobody ? 0 : c.weights[at_start];
  for (std::uint32_t t = 1; t < path.size(); ++t) {
    weight += stepWeight(c, path[t - 1], path[t], t);
  }
  const auto arrival = static_cast<std::uint32_t>(path.size() - 1);
  return {weight + holdWeight(c, arrival), arrival};
}

struct Run {
  const char* name;
  bool may_evict;
  bool hasty;
  Hurry hurry = {};
  bool without_table = false;
};

/// Looks for the first arrival in so many expansions, and for any in so many in all.
Hurry hurry(std::uint64_t begin, std::uint64_t end = Hurry::kNever,
            std::uint64_t greedy = Hurry::kNever) {
  Hurry hurry;
  hurry.begin = begin;
  hurry.greedy = greedy;
  hurry.end = end;
  return hurry;
}

class RandomCases : public ::testing::TestWithParam<Run> {};

TEST_P(RandomCases, LeastWeightThenEarliestArrival) {
  const auto& run = GetParam();
  std::uint32_t found = 0;
  for (std::uint64_t seed = 0; seed < test::draws(4000U); ++seed) {
    const Case c = randomCase(seed);
    ReservationTable table(c.grid->size());
    for (std::uint32_t i = 0; i < c.placed.size(); ++i) table.insert(i, c.placed[i]);
    const DistanceTable distances(c.grid->graph(), c.goal);
    EvictionSearch search(c.grid->graph());
    EvictionQuery query;
    query.start = c.start;
    query.distances = &distances;
    query.placed = &table;
    query.weights = run.may_evict ? &c.weights : nullptr;
    query.departure = c.departure;
    query.latest_arrival = c.latest_arrival;
    query.hasty = run.hasty;
    query.hurry = run.hurry;
    if (run.without_table) query.rows_and_columns = c.grid.get();
    const GapAnswer answer = search.search(query, Deadline());
    const std::optional<Cost> best = leastCost(c, run.may_evict);
    if (answer.cut_short) {
      EXPECT_TRUE(answer.path.empty()) << "seed " << seed;
      continue;
    }
    ASSERT_EQ(!answer.path.empty(), best.has_value()) << "seed " << seed;
    if (!best) continue;
    ++found;
    EXPECT_EQ(answer.path.front(), c.start);
    EXPECT_EQ(answer.path.back(), c.goal);
    const Cost cost = costInCase(c, answer.path);
    EXPECT_GE(cost.first, best->first) << "seed " << seed;
    if (run.hurry.end == Hurry::kNever) {
      EXPECT_EQ(cost.first, best->first) << "seed " << seed;
    }
    EXPECT_LE(cost.second, c.latest_arrival) << "seed " << seed;
    // Who evicts nobody is never hasty.
    if (run.hurry.begin == Hurry::kNever && (!run.hasty || cost.first == 0)) {
      EXPECT_EQ(cost, *best) << "seed " << seed;
    }
    std::vector<std::uint32_t> met;
    for (std::uint32_t i = 0; i < c.placed.size(); ++i) {
      if (test::meet(c.placed[i], answer.path)) met.push_back(i);
    }
    EXPECT_EQ(robotsInTheWay(table.paths(), answer.path), met) << "seed " << seed;
  }
  EXPECT_GT(found, test::draws(1000U));
}

INSTANTIATE_TEST_SUITE_P(
    EvictionSearch, RandomCases,
    ::testing::Values(Run{"MayNotEvict", false, false}, Run{"MayEvict", true, false},
                      Run{"MayEvictInHaste", true, true},
                      Run{"MayNotEvictInAHurry", false, false, hurry(3)},
                      Run{"MayEvictInAHurry", true, false, hurry(3)},
                      Run{"EndsInAHurry", true, false, hurry(3, 12)},
                      Run{"MayEvictAndIsGreedy", true, false, hurry(3, Hurry::kNever, 6)},
                      Run{"MayEvictByRowsAndColumns", true, false, {}, true},
                      Run{"MayEvictByRowsAndColumnsInAHurry", true, false, hurry(3), true}),
    [](const ::testing::TestParamInfo<Run>& run) { return run.param.name; });

/// Robots that stand in a hall of 60x60 cells, and one that goes from one corner to the other.
struct Hall {
  static constexpr std::uint32_t kSide = 60;

  Vertex at(std::uint32_t x, std::uint32_t y) const { return kSide * y + x; }
  void stand(Vertex v) {
    table.insert(static_cast<std::uint32_t>(weights.size()), {v});
    weights.push_back(1);
  }
  GapAnswer search(const Hurry& hurry) const {
    const DistanceTable distances(grid.graph(), goal);
    EvictionQuery query;
    query.start = start;
    query.distances = &distances;
    query.placed = &table;
    query.weights = &weights;
    query.latest_arrival = 300;
    query.hurry = hurry;
    return EvictionSearch(grid.graph()).search(query, Deadline());
  }

  Grid grid = Grid(kSide, kSide, std::vector<bool>(std::size_t{kSide} * kSide, true));
  ReservationTable table = ReservationTable(kSide * kSide);
  std::vector<std::uint32_t> weights;
  Vertex start = at(5, 5);
  Vertex goal = at(55, 55);
};

TEST(GapSearch, LooksAtLittleOfAHallInAHurryAndIsSoonThere) {
  std::uint64_t patient = 0;
  std::uint64_t hurried = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Hall hall;
    RandomEngine engine(seed);
    for (Vertex v = 0; v < hall.grid.size(); ++v) {
      if (v != hall.start && v != hall.goal && drawBelow(engine, 4) == 0) hall.stand(v);
    }
    const GapAnswer first = hall.search(Hurry());
    const GapAnswer soon = hall.search(hurry(0));
    ASSERT_FALSE(first.path.empty());
    EXPECT_TRUE(robotsInTheWay(hall.table.paths(), soon.path).empty());
    EXPECT_LE(soon.path.size(), first.path.size() * 5 / 4) << "seed " << seed;
    EXPECT_GE(soon.path.size(), first.path.size()) << "seed " << seed;
    patient += first.work.expansions;
    hurried += soon.work.expansions;
  }
  EXPECT_LT(4 * hurried, 3 * patient);
}

TEST(GapSearch, WaitsInAHurryForAGoalThatCannotBeHeldYet) {
  Hall hall;
  Path late(195, hall.at(55, 50));
  for (std::uint32_t y = 51; y < 60; ++y) late.push_back(hall.at(55, y));
  hall.table.insert(0, late);
  hall.weights.push_back(1);
  const GapAnswer patient = hall.search(Hurry());
  const GapAnswer hurried = hall.search(hurry(0));
  EXPECT_EQ(patient.path.size(), 201U) << "the other one is at the goal in step 199";
  EXPECT_LT(hurried.path.size(), 210U);
  EXPECT_TRUE(robotsInTheWay(hall.table.paths(), hurried.path).empty());
  EXPECT_LT(hurried.work.expansions, 300U) << "its way, and what lies around the goal";
}

TEST(EvictionSearch, FindsInAHurryWhoStandsAroundTheGoal) {
  Hall hall;
  for (const Vertex v : hall.grid.graph().neighbours(hall.goal)) hall.stand(v);
  const GapAnswer patient = hall.search(Hurry());
  const GapAnswer hurried = hall.search(hurry(100, 300));
  EXPECT_EQ(robotsInTheWay(hall.table.paths(), patient.path).size(), 1U);
  EXPECT_EQ(robotsInTheWay(hall.table.paths(), hurried.path).size(), 1U);
  EXPECT_FALSE(hurried.cut_short);
  EXPECT_GT(patient.work.expansions, hall.grid.size() / 2U);
  EXPECT_LE(hurried.work.expansions, 2 * 300U);
}

TEST(GapSearch, GoesOnFromWhereARobotIsUnderWay) {
  std::uint32_t found = 0;
  for (std::uint64_t seed = 0; seed < test::draws(4000U); ++seed) {
    Case c = randomCase(seed);
    if (c.placed.empty()) continue;
    ReservationTable table(c.grid->size());
    for (std::uint32_t i = 0; i < c.placed.size(); ++i) table.insert(i, c.placed[i]);
    const auto robot = static_cast<std::uint32_t>(c.placed.size() - 1);
    const Path before = c.placed.back();
    c.placed.pop_back();
    RandomEngine engine(seed);
    const auto kept =
        beginOfStay(before, static_cast<std::uint32_t>(drawBelow(engine, before.size())));
    table.removeTail(robot, before, kept);
    c.start = before[kept];
    c.departure = kept;
    c.latest_arrival += kept;
    const DistanceTable distances(c.grid->graph(), c.goal);
    GapQuery query;
    query.start = c.start;
    query.distances = &distances;
    query.placed = &table;
    query.departure = kept;
    query.under_way = true;
    query.latest_arrival = c.latest_arrival;
    const Path path = GapSearch(c.grid->graph()).search(query, Deadline()).path;
    const std::optional<Cost> best = leastCost(c, false, kept);
    ASSERT_EQ(!path.empty(), best.has_value()) << "seed " << seed;
    if (!best) continue;
    ++found;
    EXPECT_EQ(path.size() - 1, best->second) << "seed " << seed;
    for (std::uint32_t t = kept; t < path.size(); ++t) {
      EXPECT_EQ(occupant(c, path[t], t), kNobody) << "seed " << seed;
      const std::uint32_t weight = t > kept ? stepWeight(c, path[t - 1], path[t], t) : 0;
      EXPECT_EQ(weight, 0U) << "seed " << seed;
    }
  }
  EXPECT_GT(found, test::draws(1000U));
}

TEST(EvictionSearch, OneSearchServesManyQuestions) {
  const Case c = randomCase(7);
  ReservationTable table(c.grid->size());
  EvictionSearch search(c.grid->graph());
  for (Vertex goal = 0; goal < c.grid->size(); ++goal) {
    const DistanceTable distances(c.grid->graph(), goal);
    EvictionQuery query;
    query.start = c.start;
    query.distances = &distances;
    query.placed = &table;
    const Path path = search.search(query, Deadline()).path;
    if (distances(c.start) == DistanceTable::kUnreachable) {
      EXPECT_TRUE(path.empty());
    } else {
      EXPECT_EQ(path.size(), distances(c.start) + 1U);
    }
  }
}

/// Counted in expansions alone a search in a lane would pay as much as one in a field.
TEST(SearchWork, AStateCostsMoreWhereMoreLiesAroundIt) {
  const auto work_on = [](const std::vector<std::string>& rows, Vertex start, Vertex goal) {
    const auto grid = test::gridFromAscii(rows);
    const ReservationTable table(grid->size());
    const DistanceTable distances(grid->graph(), goal);
    GapQuery query;
    query.start = start;
    query.distances = &distances;
    query.placed = &table;
    const GapAnswer answer = GapSearch(grid->graph()).search(query, Deadline());
    EXPECT_EQ(answer.path.size(), distances(start) + 1U);
    return answer.work;
  };
  const SearchWork lane = work_on({"............"}, 0, 11);
  const SearchWork field = work_on({"............", "............", "............"}, 12, 23);
  EXPECT_EQ(lane.expansions, field.expansions) << "both go straight on";
  EXPECT_EQ(lane.tenths, SearchWork::kTenthsALook * (1 + 2 * 10) + SearchWork::kTenthsAPlace * 12);
  EXPECT_GT(field.tenths, 2 * lane.tenths);
}

/// Whoever evicts looks at the same places again, and at who is there.
TEST(SearchWork, EvictingCostsMore) {
  const auto grid = test::gridFromAscii({"......"});
  ReservationTable table(grid->size());
  table.insert(0, Path(1, 3));
  const std::vector<std::uint32_t> weights = {1};
  const DistanceTable distances(grid->graph(), 5);
  EvictionQuery query;
  query.start = 0;
  query.distances = &distances;
  query.placed = &table;
  query.latest_arrival = 20;
  EvictionSearch search(grid->graph());
  const GapAnswer alone = search.search(query, Deadline());
  EXPECT_TRUE(alone.path.empty());
  query.weights = &weights;
  const GapAnswer evicting = search.search(query, Deadline());
  EXPECT_EQ(evicting.path.size(), 6U);
  EXPECT_GE(evicting.work.tenths, alone.work.tenths + 6 * SearchWork::kTenthsAnEviction);
}

}  // namespace
}  // namespace split_mapf
