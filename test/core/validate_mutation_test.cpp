// Random valid plans are broken in one way each; the validator has to say so every time, and what
// it says about random walks has to agree with a plain reading of the rules.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "split_mapf/core/random.h"
#include "split_mapf/core/validate.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

/// Paths that obey no rule but the graph's: each robot walks at random.
Plan randomWalks(const Instance& instance, RandomEngine& engine, std::uint32_t most_steps) {
  Plan plan;
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    Path path = {instance.start(robot)};
    for (auto steps = drawBelow(engine, most_steps + 1); steps > 0; --steps) {
      const VertexRange next = instance.graph().neighbours(path.back());
      const auto choice = drawBelow(engine, next.size() + 1);
      path.push_back(choice == next.size() ? path.back() : *(next.begin() + choice));
    }
    plan.paths.push_back(std::move(path));
  }
  return plan;
}

/// The instance that asks for where the walks end; nothing when two end in one cell.
std::optional<Instance> instanceOf(const Instance& instance, const Plan& plan) {
  std::vector<Vertex> goals;
  for (const Path& path : plan.paths) goals.push_back(path.back());
  if (std::set<Vertex>(goals.begin(), goals.end()).size() != goals.size()) return std::nullopt;
  return Instance::fromVertices(instance.sharedGrid(), instance.starts(), goals);
}

using Key = std::tuple<ViolationKind, std::uint32_t, std::uint32_t, std::uint32_t>;

/// Conflicts of two robots, by comparing every pair at every step.
std::set<Key> conflictsByPairs(const Plan& plan, std::uint32_t steps) {
  std::set<Key> found;
  for (std::uint32_t t = 0; t <= steps; ++t) {
    for (std::uint32_t a = 0; a < plan.paths.size(); ++a) {
      for (std::uint32_t b = a + 1; b < plan.paths.size(); ++b) {
        const Path& p = plan.paths[a];
        const Path& q = plan.paths[b];
        if (positionAt(p, t) == positionAt(q, t)) {
          found.emplace(ViolationKind::kVertexConflict, a, b, t);
        }
        if (t > 0 && positionAt(p, t) != positionAt(p, t - 1) &&
            positionAt(p, t) == positionAt(q, t - 1) && positionAt(p, t - 1) == positionAt(q, t)) {
          found.emplace(ViolationKind::kSwapConflict, a, b, t);
        }
      }
    }
  }
  return found;
}

std::set<Key> keysOf(const std::vector<Violation>& violations) {
  std::set<Key> keys;
  for (const Violation& v : violations) keys.emplace(v.kind, v.robot, v.other, v.step);
  return keys;
}

TEST(ValidateProperty, AgreesWithTheRulesOnRandomWalksOfTwoRobots) {
  RandomEngine engine(1);
  int valid = 0;
  int invalid = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    const Instance small = test::smallInstance(seed);
    if (small.robots() < 2) continue;
    const Instance two = Instance::fromVertices(
        small.sharedGrid(), {small.start(0), small.start(1)}, {small.goal(0), small.goal(1)});
    const Plan plan = randomWalks(two, engine, 6);
    const auto instance = instanceOf(two, plan);
    if (!instance) continue;
    const std::set<Key> expected = conflictsByPairs(plan, 6);
    EXPECT_EQ(keysOf(validate(*instance, plan)), expected) << test::describe(*instance);
    ++(expected.empty() ? valid : invalid);
  }
  EXPECT_GT(valid, 100);
  EXPECT_GT(invalid, 100);
}

/// Conflicts in the order in which they are told: of each robot, step by step, with the first one
/// that it shares its cell with, and the first one that it exchanges places with.
std::vector<Key> conflictsAsTold(const Plan& plan, std::uint32_t steps) {
  std::vector<Key> told;
  const auto tell_first = [&](ViolationKind kind, std::uint32_t robot, std::uint32_t t,
                              auto meets) {
    std::uint32_t other = 0;
    while (other < robot && !meets(plan.paths[other])) ++other;
    const bool lasts = plan.paths[robot].size() > t || plan.paths[other].size() > t;
    if (other < robot && lasts) told.emplace_back(kind, other, robot, t);
  };
  for (std::uint32_t t = 0; t <= steps; ++t) {
    for (std::uint32_t robot = 0; robot < plan.paths.size(); ++robot) {
      const Path& own = plan.paths[robot];
      const Vertex at = positionAt(own, t);
      tell_first(ViolationKind::kVertexConflict, robot, t,
                 [&](const Path& path) { return positionAt(path, t) == at; });
      if (t == 0 || positionAt(own, t - 1) == at) continue;
      tell_first(ViolationKind::kSwapConflict, robot, t, [&](const Path& path) {
        return positionAt(path, t - 1) == at && positionAt(path, t) == positionAt(own, t - 1);
      });
    }
  }
  return told;
}

TEST(ValidateProperty, TellsWhatIsWrongInACrowdInOrder) {
  RandomEngine engine(3);
  std::size_t told = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const Instance instance = test::crowdedInstance(seed);
    const Plan plan = randomWalks(instance, engine, 6);
    std::vector<Key> found;
    for (const Violation& v : validate(instance, plan)) {
      const bool of_two =
          v.kind == ViolationKind::kVertexConflict || v.kind == ViolationKind::kSwapConflict;
      if (of_two) found.emplace_back(v.kind, v.robot, v.other, v.step);
    }
    EXPECT_EQ(found, conflictsAsTold(plan, 6)) << test::describe(instance);
    told += found.size();
  }
  EXPECT_GT(told, 1000U);
}

/// Random walks of up to four robots that happen to be valid.
class MutationTest : public ::testing::Test {
 protected:
  struct Sample {
    Instance instance;
    Plan plan;
  };

  void SetUp() override {
    for (std::uint64_t seed = 0; samples_.size() < 200; ++seed) {
      const Instance small = test::smallInstance(seed);
      const Plan plan = randomWalks(small, engine_, 5);
      const auto instance = instanceOf(small, plan);
      if (instance && conflictsByPairs(plan, 6).empty()) samples_.push_back({*instance, plan});
    }
  }

  bool finds(const Sample& sample, const Plan& broken, ViolationKind kind,
             std::uint32_t robot) const {
    const auto found = validate(sample.instance, broken);
    return std::any_of(found.begin(), found.end(), [&](const Violation& v) {
      return v.kind == kind && (v.robot == robot || v.other == robot);
    });
  }
  std::uint32_t drawRobot(const Sample& sample) {
    return static_cast<std::uint32_t>(drawBelow(engine_, sample.instance.robots()));
  }

  RandomEngine engine_{2};
  std::vector<Sample> samples_;
};

TEST_F(MutationTest, TheSamplesAreValid) {
  for (const Sample& sample : samples_) {
    EXPECT_TRUE(validate(sample.instance, sample.plan).empty());
  }
}

TEST_F(MutationTest, ADroppedPathIsFound) {
  for (const Sample& sample : samples_) {
    Plan broken = sample.plan;
    broken.paths.pop_back();
    EXPECT_TRUE(finds(sample, broken, ViolationKind::kRobotCount, 0));
  }
}

TEST_F(MutationTest, AForeignEntryIsFound) {
  for (const Sample& sample : samples_) {
    const std::uint32_t robot = drawRobot(sample);
    Plan broken = sample.plan;
    Path& path = broken.paths[robot];
    path[drawBelow(engine_, path.size())] = sample.instance.graph().size();
    EXPECT_TRUE(finds(sample, broken, ViolationKind::kOutsideGrid, robot));
  }
}

TEST_F(MutationTest, AnotherStartIsFound) {
  for (const Sample& sample : samples_) {
    const std::uint32_t robot = drawRobot(sample);
    Plan broken = sample.plan;
    broken.paths[robot][0] = (broken.paths[robot][0] + 1) % sample.instance.graph().size();
    EXPECT_TRUE(finds(sample, broken, ViolationKind::kWrongStart, robot));
  }
}

TEST_F(MutationTest, AnotherEndIsFound) {
  for (const Sample& sample : samples_) {
    const std::uint32_t robot = drawRobot(sample);
    Plan broken = sample.plan;
    const Vertex goal = sample.instance.goal(robot);
    broken.paths[robot].push_back((goal + 1) % sample.instance.graph().size());
    EXPECT_TRUE(finds(sample, broken, ViolationKind::kWrongGoal, robot));
  }
}

TEST_F(MutationTest, ADisplacedEntryIsFoundAsAJump) {
  int displaced = 0;
  for (const Sample& sample : samples_) {
    const std::uint32_t robot = drawRobot(sample);
    Plan broken = sample.plan;
    Path& path = broken.paths[robot];
    if (path.size() < 3) continue;
    const auto step = 1 + drawBelow(engine_, path.size() - 2);
    const auto v = static_cast<Vertex>(drawBelow(engine_, sample.instance.graph().size()));
    if (v == path[step - 1] || sample.instance.graph().adjacent(v, path[step - 1])) continue;
    path[step] = v;
    EXPECT_TRUE(finds(sample, broken, ViolationKind::kJump, robot));
    ++displaced;
  }
  EXPECT_GT(displaced, 20);
}

TEST_F(MutationTest, ACopiedPositionIsFoundAsAVertexConflict) {
  for (const Sample& sample : samples_) {
    if (sample.instance.robots() < 2) continue;
    Plan broken = sample.plan;
    const auto step = static_cast<std::uint32_t>(drawBelow(engine_, broken.paths[0].size()));
    broken.paths[0][step] = positionAt(broken.paths[1], step);
    EXPECT_TRUE(finds(sample, broken, ViolationKind::kVertexConflict, 0));
    EXPECT_TRUE(finds(sample, broken, ViolationKind::kVertexConflict, 1));
  }
}

TEST_F(MutationTest, AnExchangeOfNeighboursIsFoundAsASwap) {
  int exchanged = 0;
  for (const Sample& sample : samples_) {
    if (sample.instance.robots() < 2) continue;
    Plan broken = sample.plan;
    const Vertex a = broken.paths[0].back();
    const Vertex b = broken.paths[1].back();
    if (!sample.instance.graph().adjacent(a, b)) continue;
    for (std::uint32_t robot = 0; robot < 2; ++robot) {
      broken.paths[robot].resize(8, broken.paths[robot].back());
      broken.paths[robot].push_back(robot == 0 ? b : a);
      broken.paths[robot].push_back(robot == 0 ? a : b);
    }
    EXPECT_TRUE(finds(sample, broken, ViolationKind::kSwapConflict, 0));
    ++exchanged;
  }
  EXPECT_GT(exchanged, 5);
}

}  // namespace
}  // namespace split_mapf
