// Pricing against a search over all paths.
#include "solver/ilp/pricing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "solver/ilp/penalties.h"
#include "split_mapf/core/random.h"
#include "support/small_instances.h"

namespace split_mapf::ilp {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kTolerance = 1e-9;

/// Walks every path of at most `latest` steps and finds the cheapest of each arrival.
class AllPaths {
 public:
  AllPaths(const Instance& instance, const MoveSpace& space, const double* penalties,
           const RobotRules& rules, std::uint32_t latest)
      : instance_(instance), space_(space), penalties_(penalties), rules_(rules), latest_(latest) {}

  double cheapest() {
    path_ = {instance_.start(0)};
    walk(0);
    return best_;
  }

 private:
  void walk(double penalty) {
    const auto steps = static_cast<std::uint32_t>(path_.size()) - 1;
    const Vertex at = path_.back();
    const bool waited = steps > 0 && path_[steps - 1] == at;
    if (at == instance_.goal(0) && !waited) arrive(penalty, steps);
    if (steps >= latest_ || instance_.distances(0)(at) > latest_ - steps) return;
    step(at, penalty);
    for (const Vertex next : instance_.graph().neighbours(at)) step(next, penalty);
  }

  void step(Vertex to, double penalty) {
    const auto t = static_cast<std::uint32_t>(path_.size()) - 1;
    const double more = penalties_[space_.move(t, path_.back(), to)];
    path_.push_back(to);
    walk(penalty + more);
    path_.pop_back();
  }

  void arrive(double penalty, std::uint32_t arrival) {
    if (!rules_.allow(path_, space_.horizon())) return;
    for (std::uint32_t t = arrival; t < space_.horizon(); ++t) {
      penalty += penalties_[space_.move(t, path_.back(), path_.back())];
    }
    best_ = std::min(best_, arrival + penalty);
  }

  const Instance& instance_;
  const MoveSpace& space_;
  const double* penalties_;
  const RobotRules& rules_;
  std::uint32_t latest_;
  Path path_;
  double best_ = kInfinity;
};

RobotRules randomRules(const Instance& instance, std::uint32_t latest, RandomEngine& engine) {
  RobotRules rules;
  const auto vertex = [&] {
    return static_cast<Vertex>(drawBelow(engine, instance.graph().size()));
  };
  const auto step = [&] { return 1 + static_cast<std::uint32_t>(drawBelow(engine, latest + 1)); };
  if (drawBelow(engine, 2) == 0) {
    const std::uint32_t begin = step();
    rules.bans.push_back({vertex(), begin, begin + step()});
  }
  if (drawBelow(engine, 3) == 0) rules.posts.push_back({vertex(), step()});
  if (drawBelow(engine, 3) == 0) rules.earliest_arrival = step();
  if (drawBelow(engine, 3) == 0) rules.latest_arrival = step();
  return rules;
}

TEST(Pricing, FindsTheCheapestPathUnderPenaltiesAndRules) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    const Instance instance = test::smallInstance(seed);
    if (findCutOffRobot(instance)) continue;
    RandomEngine engine(seed);
    const std::uint32_t latest = instance.shortestLength(0) + 2;
    const MoveSpace space(instance.graph(), latest + 2);
    const RobotRules rules = randomRules(instance, latest, engine);
    Penalties penalties(space, instance.robots());
    for (int i = 0; i < 60; ++i) {
      const auto move = static_cast<MoveId>(drawBelow(engine, space.size()));
      penalties.addFor(0, move, 0.25 * static_cast<double>(drawBelow(engine, 8)));
    }
    const Window window(instance, 0, latest, space.slots());
    Pricing pricing(space, Objective::kSumOfCosts);
    penalties.cover(0, rules);
    const double cost = pricing.run(window, penalties.data(), rules);
    const double expected = AllPaths(instance, space, penalties.data(), rules, latest).cheapest();
    penalties.uncover();
    SCOPED_TRACE("seed " + std::to_string(seed) + test::describe(instance));
    if (expected == kInfinity) {
      EXPECT_EQ(cost, kInfinity);
      continue;
    }
    ASSERT_NEAR(cost, expected, kTolerance);
    const std::vector<double>& costs = pricing.costOfArrival();
    const auto arrival = std::min_element(costs.begin(), costs.end()) - costs.begin();
    const Path path = pricing.path(static_cast<std::uint32_t>(arrival));
    EXPECT_TRUE(rules.allow(path, space.horizon()));
    EXPECT_EQ(path.front(), instance.start(0));
    EXPECT_EQ(path.back(), instance.goal(0));
    ++found;
  }
  EXPECT_GT(found, 60);
}

}  // namespace
}  // namespace split_mapf::ilp
