// Cuts may forbid fractional solutions, never a plan: found for random fractions, held against
// every pair of paths that does not collide.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "solver/ilp/clique_cuts.h"
#include "solver/ilp/conflict_separator.h"
#include "solver/ilp/rectangle_cuts.h"
#include "split_mapf/core/random.h"
#include "split_mapf/core/validate.h"

namespace split_mapf::ilp {
namespace {

constexpr std::uint32_t kHorizon = 5;

/// An open room with two robots, and all their paths of kHorizon steps that go nowhere in circles.
class Cuts : public ::testing::TestWithParam<std::uint64_t> {
 protected:
  Cuts()
      : engine_(GetParam()),
        instance_(std::make_shared<const Grid>(4, 4, std::vector<bool>(16, true)), starts(),
                  {{0, 0}, {3, 3}}),
        space_(instance_.graph(), kHorizon) {
    for (std::uint32_t robot = 0; robot < 2; ++robot) {
      for (int i = 0; i < 400; ++i) paths_[robot].push_back(randomPath(robot));
    }
  }

  std::vector<Cell> starts() {
    const auto draw = [this] { return static_cast<std::int32_t>(drawBelow(engine_, 3)); };
    const Cell first{draw(), draw()};
    Cell second = first;
    while (second == first) second = {draw(), draw()};
    return {first, second};
  }

  /// Mostly onwards, to the right or down: rectangles are about paths that are on time.
  Path randomPath(std::uint32_t robot) {
    Path path = {instance_.start(robot)};
    while (path.size() <= kHorizon) {
      const VertexRange next = instance_.graph().neighbours(path.back());
      const std::uint64_t drawn = drawBelow(engine_, 10);
      if (drawn == 0) {
        path.push_back(path.back());
      } else if (drawn == 1) {
        path.push_back(next.begin()[drawBelow(engine_, next.size())]);
      } else {
        path.push_back(next.begin()[next.size() - 1 - drawBelow(engine_, 2)]);
      }
    }
    return path;
  }

  std::vector<MoveId> movesOf(const Path& path) const {
    std::vector<MoveId> moves;
    for (std::uint32_t t = 0; t < kHorizon; ++t) {
      moves.push_back(space_.move(t, path[t], path[t + 1]));
    }
    return moves;
  }

  bool collide(const Path& a, const Path& b) const {
    for (std::uint32_t t = 0; t < kHorizon; ++t) {
      if (a[t] == b[t] || a[t + 1] == b[t + 1]) return true;
      if (a[t] == b[t + 1] && a[t + 1] == b[t]) return true;
    }
    return false;
  }

  static double count(const ConflictRow& row, std::uint32_t robot,
                      const std::vector<MoveId>& moves) {
    double sum = 0;
    for (const ConflictRow::Term& term : row.terms) {
      if (term.robot != kEverybody && term.robot != robot) continue;
      for (const MoveId move : moves) sum += move == term.move ? 1 : 0;
    }
    return sum;
  }

  /// Splits each robot over a few random paths.
  std::vector<UsedPath> randomFractions() {
    chosen_.clear();
    chosen_moves_.clear();
    for (std::uint32_t robot = 0; robot < 2; ++robot) {
      for (int i = 0; i < 2; ++i) {
        chosen_.push_back(paths_[robot][drawBelow(engine_, paths_[robot].size())]);
        chosen_moves_.push_back(movesOf(chosen_.back()));
      }
    }
    std::vector<UsedPath> used;
    for (std::uint32_t i = 0; i < 4; ++i) {
      used.push_back({i / 2, 0.5, &chosen_[i], &chosen_moves_[i]});
    }
    return used;
  }

  RandomEngine engine_;
  Instance instance_;
  MoveSpace space_;
  std::vector<Path> paths_[2];
  std::vector<Path> chosen_;
  std::vector<std::vector<MoveId>> chosen_moves_;
};

TEST_P(Cuts, HoldForEveryPairOfPathsThatDoesNotCollide) {
  std::vector<ConflictRow> rows;
  RectangleCuts rectangles(instance_, space_);
  CliqueCuts cliques(space_);
  ConflictSeparator conflicts(space_);
  for (int i = 0; i < 2000 && rows.size() < 400; ++i) {
    const std::vector<UsedPath> used = randomFractions();
    const std::size_t before = rows.size();
    rectangles.find(used, 10, rows);
    cliques.find(used, 10, rows);
    conflicts.find(used, rows);
    for (std::size_t r = before; r < rows.size(); ++r) {
      double now = 0;
      for (const UsedPath& path : used) now += path.value * count(rows[r], path.robot, *path.moves);
      ASSERT_GT(now, rows[r].upper) << "a cut that cuts nothing";
    }
  }
  ASSERT_GT(rows.size(), 50U);
  int pairs = 0;
  for (int i = 0; i < 1500; ++i) {
    const Path& a = paths_[0][drawBelow(engine_, paths_[0].size())];
    const Path& b = paths_[1][drawBelow(engine_, paths_[1].size())];
    if (collide(a, b)) continue;
    ++pairs;
    const std::vector<MoveId> moves_a = movesOf(a);
    const std::vector<MoveId> moves_b = movesOf(b);
    for (const ConflictRow& row : rows) {
      ASSERT_LE(count(row, 0, moves_a) + count(row, 1, moves_b), row.upper);
    }
  }
  EXPECT_GT(pairs, 100);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Cuts, ::testing::Range<std::uint64_t>(0, 6));

}  // namespace
}  // namespace split_mapf::ilp
