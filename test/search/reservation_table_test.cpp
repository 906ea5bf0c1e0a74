#include "search/reservation_table.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "split_mapf/core/random.h"
#include "support/meeting.h"
#include "support/placed_plan.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kVertices = 40;
constexpr std::uint32_t kSteps = 400;  // checked, beyond the end of every path

/// Robots one after another along a line of vertices, each parked where it arrives.
std::vector<Path> convoy(RandomEngine& engine) {
  std::vector<Path> paths;
  for (std::uint32_t robot = 0; robot < 6; ++robot) {
    const Vertex goal = kVertices - 1 - robot;
    Path path(drawBelow(engine, 5) + std::size_t{20} * robot + 1, kVertices - 8 - 2 * robot);
    while (path.back() != goal) path.push_back(path.back() + 1);
    paths.push_back(std::move(path));
  }
  // The last starts before the others have gone by: keep those that are alone wherever they are.
  std::vector<Path> alone;
  for (const Path& path : paths) {
    bool free = true;
    for (const Path& other : alone) {
      for (std::uint32_t t = 0; t < kSteps; ++t) {
        free = free && positionAt(path, t) != positionAt(other, t);
      }
    }
    if (free) alone.push_back(path);
  }
  return alone;
}

void expectBits(const ReservationTable& table, const std::vector<Path>& paths) {
  for (Vertex v = 0; v < kVertices; ++v) {
    for (std::uint32_t t = 0; t < kSteps; ++t) {
      bool somebody = false;
      for (const Path& path : paths) {
        somebody = somebody || (!path.empty() && positionAt(path, t) == v);
      }
      ASSERT_EQ(table.isTaken(v, t), somebody) << "vertex " << v << " step " << t;
    }
  }
}

TEST(ReservationTable, BitsSayWhoIsWhereWhateverComesAndGoes) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RandomEngine engine(seed);
    ReservationTable table(kVertices);
    std::vector<Path> paths = convoy(engine);
    ASSERT_GT(paths.size(), 1U);
    for (std::uint32_t i = 0; i < paths.size(); ++i) table.insert(i, paths[i]);
    expectBits(table, paths);
    const auto gone = static_cast<std::uint32_t>(drawBelow(engine, paths.size()));
    table.remove(gone, paths[gone]);
    paths[gone].clear();
    expectBits(table, paths);
  }
}

constexpr Vertex kMiddle = 200;  // farther from both ends of a line than anybody wanders

/// On a line of vertices, waits and steps either way.
Path wander(RandomEngine& engine) {
  Path path = {kMiddle};
  for (std::size_t steps = drawBelow(engine, 150); steps > 0; --steps) {
    path.push_back(path.back() + static_cast<Vertex>(drawBelow(engine, 3)) - 1);
  }
  while (path.size() > 1 && path[path.size() - 2] == path.back()) path.pop_back();
  return path;
}

TEST(ReservationTable, KnowsWhetherTheRestOfAPathIsFree) {
  int free = 0;
  int tried = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    RandomEngine engine(seed);
    const Path other = wander(engine);
    const Path path = wander(engine);
    const auto from = static_cast<std::uint32_t>(drawBelow(engine, path.size()));
    const bool comes = from == 0 || path[from] != path[from - 1];
    const bool alone = positionAt(other, from) != path[from];
    if (!comes || !alone) continue;
    ReservationTable table(2 * kMiddle);
    table.insert(0, other);
    const bool expected = !test::meet(path, other, from);
    EXPECT_EQ(table.isFree(path, from), expected) << "seed " << seed;
    ++tried;
    free += expected;
  }
  EXPECT_GT(free, tried / 10);
  EXPECT_LT(free, tried * 9 / 10);
}

TEST(ReservationTable, TailsComeAndGo) {
  const Path parked = {3, 2};
  Path before(70, 10);  // a visit of 70 steps, then on
  for (Vertex v = 11; v < 20; ++v) before.push_back(v);
  Path after(before.begin(), before.begin() + 72);  // until its second step on the way
  after.resize(140, 11);
  for (const Vertex v : {12U, 22U}) after.push_back(v);
  for (const std::uint32_t kept : {0U, 70U, 71U}) {
    SCOPED_TRACE(kept);
    ReservationTable table(kVertices);
    table.insert(0, parked);
    table.insert(1, before);
    table.removeTail(1, before, kept);
    for (Vertex v = 0; v < kVertices; ++v) {
      for (std::uint32_t t = 0; t < kSteps; ++t) {
        const bool there = t <= kept && before[t] == v;
        ASSERT_EQ(table.isTaken(v, t), there || positionAt(parked, t) == v);
      }
    }
    const Stay& last = table.at(before[kept]).back();
    EXPECT_EQ(last.end, kept + 1) << "it is there for one step";
    EXPECT_EQ(last.next, kNoVertex);
    table.insertTail(1, after, kept);
    expectBits(table, {parked, after});
    table.removeTail(1, after, kept);
    table.insertTail(1, before, kept);
    expectBits(table, {parked, before});
    ReservationTable fresh(kVertices);
    fresh.insert(0, parked);
    fresh.insert(1, before);
    test::expectSame(table, fresh, kVertices);
  }
}

TEST(ReservationTable, HeadsGoToo) {
  const Path parked = {3, 2};
  const Path path = {10, 10, 11, 12, 10, 9};
  for (const std::uint32_t kept : {0U, 2U, 3U, 4U}) {
    SCOPED_TRACE(kept);
    ReservationTable table(kVertices);
    table.insert(0, parked);
    table.insert(1, path);
    table.removeTail(1, path, kept);
    table.removeHead(1, path, kept);
    expectBits(table, {parked});
    ReservationTable fresh(kVertices);
    fresh.insert(0, parked);
    test::expectSame(table, fresh, kVertices);
  }
}

TEST(ReservationTable, FindsTheEndsOfGaps) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    RandomEngine engine(seed);
    ReservationTable table(2 * kMiddle);
    table.insert(0, wander(engine));
    const Vertex v = kMiddle + static_cast<Vertex>(drawBelow(engine, 3));
    const auto t = static_cast<std::uint32_t>(drawBelow(engine, 200));
    const auto last = t + static_cast<std::uint32_t>(drawBelow(engine, 200));
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::uint32_t comes = t + 1;
    while (comes <= last && !table.isTaken(v, comes)) ++comes;
    EXPECT_EQ(table.takenAfter(v, t, last), comes);
    std::uint32_t since = t;
    while (since > 0 && !table.isTaken(v, since - 1)) --since;
    EXPECT_EQ(table.freeSince(v, t), since);
  }
}

TEST(ReservationTable, ALongPathKeepsWhoIsParkedParked) {
  ReservationTable table(kVertices);
  const Path parked = {3, 2};
  table.insert(0, parked);
  EXPECT_TRUE(table.isTaken(2, 1000));
  Path late(300, 7);
  late.push_back(8);
  table.insert(1, late);
  expectBits(table, {parked, late});
  EXPECT_TRUE(table.isTaken(2, 1000));
  EXPECT_TRUE(table.isTaken(8, 1000));
  EXPECT_FALSE(table.isTaken(7, 1000));
}

TEST(ReservationTable, EndsThatFillAWordExactly) {
  for (const std::size_t steps : {63U, 64U, 65U, 127U, 128U, 129U}) {
    ReservationTable table(kVertices);
    Path path(steps - 1, 5);
    path.push_back(6);
    table.insert(0, path);
    expectBits(table, {path});
    table.remove(0, path);
    expectBits(table, {});
  }
}

}  // namespace
}  // namespace split_mapf
