#include "split_mapf/pipeline/piece_bytes.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/roadmap/roadmap.h"
#include "split_mapf/solver/registry.h"
#include "split_mapf/split/splitter_registry.h"
#include "support/ascii_grid.h"
#include "support/drawn_rooms.h"
#include "support/small_instances.h"

namespace split_mapf {
namespace {

std::vector<PieceHandle> cut(const Instance& instance, const std::string& split) {
  const SplitRequest request = builtinSplitters().read(split, {}, Objective::kMakespan);
  const SolvabilityChecker checker(instance.graph());
  const auto splitter = builtinSplitters().find(request)->make(request, {instance, checker, 0, {}});
  EXPECT_TRUE(splitter->split(Deadline()));
  return piecesOf(splitter->tree());
}

SolveResult solve(const Piece& piece, const std::string& solver, std::uint64_t limit = 0) {
  SolverOptions options;
  options.seed = 3;
  options.expansion_limit = limit;
  return builtinSolvers().create(solver, options)->solve(SolveRequest(*piece.instance));
}

/// That every piece is the same behind its journey, to all solvers.
void expectTheSamePlans(const Instance& instance, const std::string& split) {
  SCOPED_TRACE(split);
  const std::vector<PieceHandle> pieces = cut(instance, split);
  EXPECT_GT(pieces.size(), 1U);
  int solved = 0;
  for (const PieceHandle& piece : pieces) {
    const std::string bytes = toBytes(*piece);
    const Piece arrived = pieceFromBytes(bytes);
    EXPECT_EQ(toBytes(arrived), bytes);
    EXPECT_EQ(arrived.id, piece->id);
    EXPECT_EQ(arrived.robots, piece->robots);
    ASSERT_EQ(arrived.map == nullptr, piece->map == nullptr);
    if (piece->map) {
      EXPECT_EQ(*arrived.map, *piece->map);
    }
    for (const char* solver : {"conflict_optimizer", "ecbs", "lacam", "prioritized"}) {
      const SolveResult here = solve(*piece, solver, 200000);
      const SolveResult there = solve(arrived, solver, 200000);
      ASSERT_EQ(there.termination, here.termination) << solver;
      EXPECT_EQ(there.low_level_expansions, here.low_level_expansions) << solver;
      if (!here.plan) continue;
      ASSERT_TRUE(there.plan) << solver;
      EXPECT_EQ(there.plan->paths, here.plan->paths) << solver;
      EXPECT_TRUE(validate(*arrived.instance, *there.plan).empty());
      ++solved;
    }
  }
  EXPECT_GT(solved, 0);
}

TEST(PieceBytes, APieceIsSolvedElsewhereToTheSamePlan) {
  const Instance instance = test::generatedInstance(20, 0.15, 60);
  for (const char* split : {"3t", "2x2s", "2s2t"}) expectTheSamePlans(instance, split);
}

TEST(PieceBytes, SoIsOneOnAPlanningGraph) {
  RoadmapOptions options;
  options.robot_radius_m = 0.3;
  const auto grid = gridOf(*buildRoadmap(test::drawRooms(1, 13, 54, 0.05).raster, options));
  ASSERT_FALSE(grid->hasUnitMoves());
  std::vector<Vertex> starts;
  std::vector<Vertex> goals;
  for (Vertex robot = 0; robot < 6; ++robot) {
    starts.push_back(robot * 7);
    goals.push_back(grid->size() - 1 - robot * 5);
  }
  expectTheSamePlans(Instance::fromVertices(grid, starts, goals), "3t");
}

TEST(PieceBytes, BrokenBytesAreRefusedInPlainWords) {
  const Piece piece = *cut(test::generatedInstance(8, 0.1, 6), "2t").front();
  const std::string bytes = toBytes(piece);
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_THROW(pieceFromBytes(bytes.substr(0, length)), InputError) << length;
  }
  EXPECT_THROW(pieceFromBytes(bytes + "."), InputError);
  try {
    pieceFromBytes("PIECE1");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "piece: byte 6: the bytes end where the piece's number is expected");
  }
  // Whatever a byte becomes, the piece is refused or well-posed.
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const char flip : {'\x01', '\x10', '\x7f', '\x80'}) {
      std::string wrong = bytes;
      wrong[i] = static_cast<char>(wrong[i] ^ flip);
      try {
        const Piece read = pieceFromBytes(wrong);
        EXPECT_EQ(read.robots.size(), read.instance->robots());
      } catch (const InputError&) {  // as it should be
      }
    }
  }
}

}  // namespace
}  // namespace split_mapf
