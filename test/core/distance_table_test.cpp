#include "split_mapf/core/distance_table.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "core/table_pool.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/core/random.h"
#include "support/ascii_grid.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

using test::gridFromAscii;
using test::serpentineGrid;

/// Distances by repeated relaxation: slow, and nothing like a breadth-first search.
std::vector<std::uint32_t> relax(const Graph& graph, Vertex goal) {
  std::vector<std::uint32_t> d(graph.size(), DistanceTable::kUnreachable);
  d[goal] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (Vertex v = 0; v < graph.size(); ++v) {
      for (const Vertex u : graph.neighbours(v)) {
        if (d[u] != DistanceTable::kUnreachable && d[u] + 1 < d[v]) {
          d[v] = d[u] + 1;
          changed = true;
        }
      }
    }
  }
  return d;
}

TEST(DistanceTable, WalksRoundObstacles) {
  const auto grid = gridFromAscii({".#.",  //
                                   ".#.",  //
                                   "..."});
  const DistanceTable table(grid->graph(), grid->vertexAt({2, 0}));
  EXPECT_EQ(table(grid->vertexAt({2, 0})), 0U);
  EXPECT_EQ(table(grid->vertexAt({0, 0})), 6U);
  EXPECT_FALSE(table.isWide());
}

TEST(DistanceTable, MarksWhatCannotReachTheGoal) {
  const auto grid = gridFromAscii({".#."});
  const DistanceTable table(grid->graph(), 0);
  EXPECT_EQ(table(1), DistanceTable::kUnreachable);
}

TEST(DistanceTable, AgreesWithRelaxationOnRandomGrids) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Instance instance = test::smallInstance(seed);
    const std::vector<std::uint32_t> expected = relax(instance.graph(), instance.goal(0));
    const HeldDistances table = instance.distances(0);
    for (Vertex v = 0; v < instance.graph().size(); ++v) EXPECT_EQ(table(v), expected[v]);
  }
}

TEST(DistanceTable, AgreesWithRelaxationOnGraphsOfAnyDegree) {
  std::uint32_t rows_of_four = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    RandomEngine engine(seed);
    std::vector<std::pair<Vertex, Vertex>> edges(drawBelow(engine, 60));
    for (auto& [a, b] : edges) {
      a = static_cast<Vertex>(drawBelow(engine, 20));
      b = static_cast<Vertex>(drawBelow(engine, 20));
    }
    const Graph graph(20, edges);
    if (graph.rowsOfFour() != nullptr) ++rows_of_four;
    const std::vector<std::uint32_t> expected = relax(graph, 0);
    const DistanceTable table(graph, 0);
    for (Vertex v = 0; v < graph.size(); ++v) EXPECT_EQ(table(v), expected[v]) << "seed " << seed;
  }
  EXPECT_GT(rows_of_four, 20U);
  EXPECT_LT(rows_of_four, 80U) << "both searches have their turns";
}

/// A path graph: the distance from one end is the vertex itself.
Graph chain(std::uint32_t size) {
  std::vector<std::pair<Vertex, Vertex>> edges;
  for (Vertex v = 0; v + 1 < size; ++v) edges.emplace_back(v, v + 1);
  return {size, edges};
}

TEST(DistanceTable, StaysExactBeyondSixteenBits) {
  const auto grid = serpentineGrid(400);
  const Vertex last = grid->size() - 1;
  const DistanceTable table(grid->graph(), 0);
  ASSERT_GT(grid->size(), 65536U);
  ASSERT_TRUE(table.isWide());
  // The corridor is a single chain: the greatest distance is the number of cells minus one, and
  // every distance occurs once.
  std::vector<bool> seen(grid->size(), false);
  for (Vertex v = 0; v <= last; ++v) {
    ASSERT_LT(table(v), grid->size());
    EXPECT_FALSE(seen[table(v)]);
    seen[table(v)] = true;
  }
}

TEST(DistanceTable, ChangesWidthExactlyWhereSixteenBitsEnd) {
  const Graph fits = chain(65535);  // greatest distance 65534; 65535 marks the unreachable
  EXPECT_FALSE(DistanceTable(fits, 0).isWide());
  EXPECT_EQ(DistanceTable(fits, 0)(65534), 65534U);
  const Graph exceeds = chain(65536);
  EXPECT_TRUE(DistanceTable(exceeds, 0).isWide());
  EXPECT_EQ(DistanceTable(exceeds, 0)(65535), 65535U);
  EXPECT_FALSE(DistanceTable(exceeds, 32768).isWide());
}

TEST(DistanceTableOnDemand, SaysTheSameInWhateverOrderItIsAsked) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Instance instance = test::smallInstance(seed);
    const DistanceTable whole(instance.graph(), instance.goal(0));
    const DistanceTable lazy(instance.graph(), instance.goal(0), DistanceExtent::kOnDemand);
    RandomEngine engine(seed);
    for (int question = 0; question < 60; ++question) {
      const auto v = static_cast<Vertex>(drawBelow(engine, instance.graph().size()));
      ASSERT_EQ(lazy(v), whole(v)) << "seed " << seed << " vertex " << v;
    }
  }
}

TEST(DistanceTableOnDemand, StaysExactBeyondSixteenBits) {
  const auto grid = test::serpentineGrid(400);
  const Vertex last = grid->size() - 1;
  const DistanceTable whole(grid->graph(), 0);
  const DistanceTable lazy(grid->graph(), 0, DistanceExtent::kOnDemand);
  EXPECT_EQ(lazy(10), whole(10));
  EXPECT_FALSE(lazy.isWide());
  EXPECT_EQ(lazy(last), whole(last));
  EXPECT_TRUE(lazy.isWide());
  for (Vertex v = 0; v < grid->size(); ++v) ASSERT_EQ(lazy(v), whole(v));
}

/// Random vertices of a random grid on which not everybody can reach everybody.
struct GuidedCase {
  explicit GuidedCase(std::uint64_t seed) : engine(seed) {
    const std::uint32_t width = 3 + static_cast<std::uint32_t>(drawBelow(engine, 18));
    const std::uint32_t height = 3 + static_cast<std::uint32_t>(drawBelow(engine, 18));
    std::vector<bool> free(std::size_t{width} * height);
    for (std::size_t i = 0; i < free.size(); ++i) free[i] = drawBelow(engine, 10) >= 3;
    free[0] = true;
    grid = std::make_shared<const Grid>(width, height, free);
  }
  Vertex draw() { return static_cast<Vertex>(drawBelow(engine, grid->size())); }

  RandomEngine engine;
  std::shared_ptr<const Grid> grid;
};

TEST(DistanceTableGuided, SaysTheSameInWhateverOrderItIsAsked) {
  std::uint32_t unreachable = 0;
  for (std::uint64_t seed = 0; seed < 600; ++seed) {
    GuidedCase random(seed);
    const Grid& grid = *random.grid;
    const Vertex goal = random.draw();
    DistanceGuide guide{&grid, random.draw(), nullptr};
    if (seed % 3 > 0) {
      const auto extent = seed % 6 == 5 ? DistanceExtent::kOnDemand : DistanceExtent::kAll;
      guide.known = std::make_shared<const DistanceTable>(grid.graph(), random.draw(), extent);
    }
    const std::vector<std::uint32_t> expected = relax(grid.graph(), goal);
    const DistanceTable guided(goal, guide);
    EXPECT_FALSE(guided.isShareable());
    EXPECT_EQ(guided.narrowEntries(), nullptr);
    if (seed % 2 == 0) {
      ASSERT_EQ(guided(guide.from), expected[guide.from]);
    }
    for (int question = 0; question < 100; ++question) {
      const Vertex v = random.draw();
      ASSERT_EQ(guided(v), expected[v]) << "seed " << seed << " vertex " << v;
      unreachable += expected[v] == DistanceTable::kUnreachable;
    }
  }
  EXPECT_GT(unreachable, 1000U) << "what cannot be reached was hardly asked for";
}

TEST(DistanceTableGuided, StaysExactBeyondSixteenBits) {
  const auto grid = serpentineGrid(400);
  const Vertex last = grid->size() - 1;
  const DistanceTable whole(grid->graph(), 0);
  // Distances to the middle fit, those to the end do not.
  Vertex middle = 0;
  while (whole(middle) != grid->size() / 2) ++middle;
  const auto known = std::make_shared<const DistanceTable>(grid->graph(), middle);
  ASSERT_FALSE(known->isWide());
  const DistanceTable guided(0, {grid.get(), last, known});
  EXPECT_EQ(guided(10), whole(10));
  for (Vertex v = 0; v < grid->size(); ++v) ASSERT_EQ(guided(v), whole(v));
  EXPECT_TRUE(guided.isWide());
}

TEST(DistanceTables, ManyThreadsShareOneTableAGoal) {
  const auto grid = serpentineGrid(40);
  std::vector<Vertex> goals(64);
  for (std::uint32_t i = 0; i < goals.size(); ++i) goals[i] = i * 7;
  const DistanceTables tables(grid->graph(), goals);
  std::vector<std::vector<const DistanceTable*>> seen(8);
  std::atomic<std::uint32_t> ready{0};
  std::vector<std::thread> threads;
  for (std::uint32_t t = 0; t < 8; ++t) {
    threads.emplace_back([&, t] {
      for (++ready; ready < 8;) std::this_thread::yield();
      for (std::uint32_t i = 0; i < goals.size(); ++i) {
        const HeldDistances held = tables[i];
        seen[t].push_back(&*held);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::uint32_t i = 0; i < goals.size(); ++i) {
    EXPECT_EQ(seen[0][i]->goal(), goals[i]);
    for (std::uint32_t t = 1; t < 8; ++t) EXPECT_EQ(seen[t][i], seen[0][i]);
  }
}

TEST(DistanceTables, TakeOverATableThatStandsAlready) {
  const auto grid = gridFromAscii({"...."});
  const auto table = std::make_shared<const DistanceTable>(grid->graph(), 3);
  const DistanceTables tables(*grid, {0, 3}, DistanceExtent::kAll, {nullptr, table});
  const HeldDistances held = tables[1];
  EXPECT_EQ(&*held, table.get());
  EXPECT_EQ(tables.share(1), table);
  EXPECT_EQ(tables[0](3), 3U);
}

TEST(DistanceTableGuided, CompletesItselfWhereMuchIsAsked) {
  const auto grid = serpentineGrid(40);
  const Vertex last = grid->size() - 1;
  const DistanceTable whole(grid->graph(), 0);
  const DistanceTable guided(0, {grid.get(), last, nullptr, true});
  EXPECT_FALSE(guided.isShareable());
  EXPECT_EQ(guided(last), whole(last));  // round all the serpentine
  EXPECT_TRUE(guided.isShareable());
  ASSERT_NE(guided.narrowEntries(), nullptr);
  for (Vertex v = 0; v < grid->size(); ++v) ASSERT_EQ(guided(v), whole(v));
}

/// A table as those of a pool are: it begins with ways from wherever somebody asks.
DistanceTable tableOfAPool(const Grid& grid, Vertex goal, Vertex from) {
  return {goal, DistanceGuide{&grid, from, nullptr, true}};
}

std::shared_ptr<const Grid> strewnGrid(std::uint32_t side, std::uint64_t blocked_of_100,
                                       RandomEngine& engine) {
  std::vector<bool> free(std::size_t{side} * side);
  for (std::size_t i = 0; i < free.size(); ++i) free[i] = drawBelow(engine, 100) >= blocked_of_100;
  free[0] = true;
  return std::make_shared<const Grid>(side, side, free);
}

TEST(DistanceTableOfDetours, SaysTheSameAsASearchOfAll) {
  std::uint32_t unreachable = 0;
  std::uint32_t in_part = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    RandomEngine engine(seed);
    const auto grid = strewnGrid(40, 5 * (seed % 8), engine);
    const auto draw = [&] { return static_cast<Vertex>(drawBelow(engine, grid->size())); };
    const Vertex goal = draw();
    const DistanceTable whole(grid->graph(), goal);
    const DistanceTable table = tableOfAPool(*grid, goal, draw());
    for (int question = 0; question < 30; ++question) {
      const Vertex v = draw();
      ASSERT_EQ(table(v), whole(v)) << "seed " << seed << " vertex " << v;
      for (const Vertex u : grid->graph().neighbours(v)) ASSERT_EQ(table(u), whole(u));
      unreachable += whole(v) == DistanceTable::kUnreachable;
      in_part += table.isShareable() ? 0 : 1;
    }
  }
  EXPECT_GT(unreachable, 20U);
  EXPECT_GT(in_part, 500U) << "nearly all were searched as a whole";
}

TEST(DistanceTableOfDetours, KnowsThatAGoalIsOpenOnTheFarSideOnly) {
  // A pocket around the goal, open to the right: all ways from the left have two steps away.
  const std::uint32_t side = 200;
  std::vector<bool> free(std::size_t{side} * side, true);
  const auto block = [&](std::uint32_t x, std::uint32_t y) {
    free[std::size_t{y} * side + x] = false;
  };
  for (std::uint32_t x = 148; x <= 151; ++x) block(x, 148);
  for (std::uint32_t x = 148; x <= 151; ++x) block(x, 152);
  for (std::uint32_t y = 148; y <= 152; ++y) block(148, y);
  const Grid grid(side, side, free);
  const Vertex goal = grid.vertexAt({149, 150});
  const Vertex from = grid.vertexAt({3, 9});
  const DistanceTable whole(grid.graph(), goal);
  const DistanceTable table = tableOfAPool(grid, goal, from);
  EXPECT_EQ(table(from), whole(from));
  EXPECT_EQ(whole(from), 287U + 2 * 3);
  EXPECT_FALSE(table.isShareable()) << "it looked for shorter ways all over the map";
  EXPECT_LT(table.bytes(), 70000U) << "likewise";
}

TEST(DistanceTableOfDetours, SoughtOnAllOverTheMapForALaterQuestion) {
  // A wall that is open at its upper end only, which is the last that is tried.
  const std::uint32_t side = 300;
  std::vector<bool> free(std::size_t{side} * side, true);
  for (std::uint32_t y = 31; y < side; ++y) free[std::size_t{y} * side + 264] = false;
  const Grid grid(side, side, free);
  const Vertex goal = grid.vertexAt({270, 270});
  const Vertex near = grid.vertexAt({285, 264});
  const Vertex behind = grid.vertexAt({10, 30});
  const DistanceTable whole(grid.graph(), goal);
  const DistanceTable table = tableOfAPool(grid, goal, near);
  EXPECT_EQ(table(near), whole(near));
  EXPECT_FALSE(table.isShareable());
  EXPECT_EQ(table(behind), whole(behind));
  EXPECT_TRUE(table.isShareable()) << "it went on for two thirds of the map";
}

TEST(DistanceTablesOfAPool, SayTheSameWhateverIsGivenUp) {
  for (const std::size_t bytes : {std::size_t{1}, std::size_t{4000}, std::size_t{1} << 30U}) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      GuidedCase random(seed);
      const Grid& grid = *random.grid;
      std::vector<Vertex> starts(5);
      std::vector<Vertex> goals(5);
      for (std::uint32_t i = 0; i < 5; ++i) starts[i] = random.draw();
      for (std::uint32_t i = 0; i < 5; ++i) goals[i] = random.draw();
      const auto pool = std::make_shared<TablePool>(bytes);
      const DistanceTables tables(grid, starts, goals, pool);
      for (std::uint32_t turn = 0; turn < 40; ++turn) {
        const auto i = static_cast<std::uint32_t>(drawBelow(random.engine, 5));
        const Vertex v = random.draw();
        ASSERT_EQ(tables[i](v), DistanceTable(grid.graph(), goals[i])(v));
        ASSERT_EQ(tables.lengthFrom(starts[i], i),
                  DistanceTable(grid.graph(), goals[i])(starts[i]));
        ASSERT_LE(pool->bytes(), bytes);
        if (turn % 8 == 7) tables.giveUp(i);
      }
    }
  }
}

TEST(DistanceTablesOfAPool, BelongToOneHolderAtATime) {
  const auto grid = serpentineGrid(40);
  const auto pool = std::make_shared<TablePool>(std::size_t{1} << 30U);
  const auto tables = std::make_unique<const DistanceTables>(*grid, std::vector<Vertex>{9},
                                                             std::vector<Vertex>{0}, pool);
  const DistanceTable* first = nullptr;
  {
    const HeldDistances one = (*tables)[0];
    HeldDistances two = (*tables)[0];
    first = &*one;
    EXPECT_NE(first, &*two);
    EXPECT_EQ(one(9), two(9));
    EXPECT_EQ(pool->bytes(), 0U);
    two = HeldDistances(*one);  // the other goes back
    EXPECT_GT(pool->bytes(), 0U);
  }
  tables->giveUp(0);
  EXPECT_EQ(pool->bytes(), 0U);
  EXPECT_EQ((*tables)[0](9), 9U);
  EXPECT_GT(pool->bytes(), 0U);
}

TEST(DistanceTablesOfAPool, LeaveItWithTheirOwner) {
  const auto grid = serpentineGrid(40);
  const auto pool = std::make_shared<TablePool>(std::size_t{1} << 30U);
  for (std::uint32_t round = 0; round < 2; ++round) {
    const DistanceTables tables(*grid, {9, 8}, {0, 1}, pool);
    EXPECT_EQ(tables[1](8), 7U);
    EXPECT_GT(pool->bytes(), 0U);
  }
  EXPECT_EQ(pool->bytes(), 0U);
}

}  // namespace
}  // namespace split_mapf
