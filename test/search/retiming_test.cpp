#include "search/retiming.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "split_mapf/core/instance.h"
#include "split_mapf/core/validate.h"
#include "support/meeting.h"
#include "support/placed_plan.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

Path routeOf(Path path) {
  path.erase(std::unique(path.begin(), path.end()), path.end());
  return path;
}

std::size_t dearnessOf(const Path& path, const ReservationTable& others) {
  std::size_t sum = 0;
  for (std::size_t t = 1; t < path.size(); ++t) {
    if (path[t] == path[t - 1]) sum += others.at(path[t]).size();
  }
  return sum;
}

/// What the waits cost where they cost least: tries all timings that come to no vertex sooner than
/// the path does, nor after a robot that came to it later.
class EveryTiming {
 public:
  EveryTiming(const Plan& plan, std::uint32_t robot, const ReservationTable& others)
      : plan_(plan), robot_(robot), others_(others), route_(routeOf(plan.paths[robot])) {}

  std::size_t least() {
    Path path = {route_.front()};
    extend(path, 0);
    return least_;
  }

 private:
  void extend(Path& path, std::size_t reached) {
    const std::size_t size = plan_.paths[robot_].size();
    if (path.size() == size) {
      if (reached + 1 == route_.size() && isAlone(path)) {
        least_ = std::min(least_, dearnessOf(path, others_));
      }
      return;
    }
    for (const std::size_t next : {reached, reached + 1}) {
      if (next >= route_.size() || route_.size() - 1 - next > size - 1 - path.size()) continue;
      const auto t = static_cast<std::uint32_t>(path.size());
      if (next > visitAt(t)) continue;
      if (next != reached && somebodyComes(next, t)) continue;
      path.push_back(route_[next]);
      extend(path, next);
      path.pop_back();
    }
  }
  /// The number of the vertex of the route at which the path is.
  std::size_t visitAt(std::uint32_t t) const {
    const Path& path = plan_.paths[robot_];
    std::size_t visit = 0;
    for (std::uint32_t i = 1; i <= t; ++i) visit += path[i] != path[i - 1];
    return visit;
  }
  /// To a vertex of the route since the path did, until step `until`.
  bool somebodyComes(std::size_t visit, std::uint32_t until) const {
    for (std::uint32_t t = 0; t <= until; ++t) {
      if (visitAt(t) >= visit && others_.isTaken(route_[visit], t)) return true;
    }
    return false;
  }
  bool isAlone(const Path& path) const {
    for (std::uint32_t i = 0; i < plan_.paths.size(); ++i) {
      if (i != robot_ && test::meet(path, plan_.paths[i])) return false;
    }
    return true;
  }

  const Plan& plan_;
  std::uint32_t robot_;
  const ReservationTable& others_;
  Path route_;
  std::size_t least_ = SIZE_MAX;
};

TEST(WaitPlacer, WaitsWhereItIsCheapestOfAllTimings) {
  WaitPlacer placer;
  int cheaper = 0;
  int waiting = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Instance instance = test::generatedInstance(6, 0.1, 12, seed);
    Plan plan = test::planWithDelays(instance);
    ReservationTable table(instance.graph().size(), plan);
    for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
      Path& path = plan.paths[robot];
      const Path before = path;
      const Path route = routeOf(path);
      if (path.size() > 16) continue;  // too many timings
      table.remove(robot, path);
      const std::size_t least = EveryTiming(plan, robot, table).least();
      placer.place(table, path);
      SCOPED_TRACE("seed " + std::to_string(seed) + " robot " + std::to_string(robot));
      EXPECT_EQ(path.size(), before.size());
      EXPECT_EQ(routeOf(path), route);
      EXPECT_EQ(dearnessOf(path, table), least);
      cheaper += least < dearnessOf(before, table);
      waiting += route.size() < before.size();
      table.insert(robot, path);
    }
    EXPECT_TRUE(validate(instance, plan).empty());
  }
  EXPECT_GT(waiting, 50);
  EXPECT_GT(cheaper, 10);
}

TEST(WaitPlacer, KeepsWhatComesBefore) {
  const Instance instance = test::generatedInstance(16, 0.1, 70);
  Plan plan = test::planWithDelays(instance);
  ReservationTable table(instance.graph().size(), plan);
  WaitPlacer placer;
  int changed = 0;
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    Path& path = plan.paths[robot];
    const Path before = path;
    const std::uint32_t kept = beginOfStay(path, static_cast<std::uint32_t>(path.size() / 2));
    table.removeTail(robot, path, kept);
    placer.place(table, path, kept);
    EXPECT_TRUE(std::equal(before.begin(), before.begin() + kept + 1, path.begin()));
    EXPECT_EQ(path.size(), before.size());
    changed += path != before;
    table.insertTail(robot, path, kept);
  }
  EXPECT_TRUE(validate(instance, plan).empty());
  EXPECT_GT(changed, 0);
}

TEST(SoonestAlong, IsAtNoVertexLaterAndInNobodysWay) {
  int sooner = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Instance instance = test::generatedInstance(16, 0.1, 70, seed);
    Plan plan = test::planWithDelays(instance);
    ReservationTable table(instance.graph().size(), plan);
    WaitPlacer placer;
    for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
      Path& path = plan.paths[robot];
      table.remove(robot, path);
      placer.place(table, path);
      table.insert(robot, path);
      const Path soonest = soonestAlong(table, path);
      EXPECT_EQ(routeOf(soonest), routeOf(path));
      EXPECT_LE(soonest.size(), path.size());
      // It comes to no vertex of the route later than the path does.
      std::uint32_t ahead = 0;
      for (std::uint32_t t = 0, visit = 0, soonest_visit = 0; t < path.size(); ++t) {
        visit += t > 0 && path[t] != path[t - 1];
        soonest_visit += t > 0 && positionAt(soonest, t) != positionAt(soonest, t - 1);
        EXPECT_GE(soonest_visit, visit);
        ahead += soonest_visit > visit;
      }
      sooner += ahead > 0;
      table.remove(robot, path);
      path = soonest;
      table.insert(robot, path);
    }
    EXPECT_TRUE(validate(instance, plan).empty()) << "seed " << seed;
  }
  EXPECT_GT(sooner, 50);
}

}  // namespace
}  // namespace split_mapf
