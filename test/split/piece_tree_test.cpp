#include "split_mapf/split/piece_tree.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <utility>

#include "split_mapf/core/validate.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

class Stitching : public testing::Test {
 protected:
  PieceTree leaf(PieceId id, const std::vector<Vertex>& from, const std::vector<Vertex>& to,
                 std::vector<std::uint32_t> robots) {
    Piece piece;
    piece.id = id;
    piece.instance = std::make_shared<const Instance>(Instance::fromVertices(grid_, from, to));
    piece.robots = std::move(robots);
    return PieceTree::leaf(std::make_shared<const Piece>(std::move(piece)));
  }
  std::shared_ptr<const Grid> grid_ = test::gridFromAscii({"......"});
};

TEST_F(Stitching, SequencesBeginWhenTheSlowestHasArrived) {
  const PieceTree tree = PieceTree::sequence(
      std::vector<PieceTree>{leaf(0, {0, 3}, {2, 4}, {0, 1}), leaf(1, {2, 4}, {3, 5}, {0, 1})});
  const Plan plan = stitch(tree, {{0, {{{0, 1, 2}, {3, 4}}}}, {1, {{{2, 3}, {4, 5}}}}}, 2);
  EXPECT_EQ(plan.paths[0], (Path{0, 1, 2, 3}));
  EXPECT_EQ(plan.paths[1], (Path{3, 4, 4, 5}));
  const Instance whole = Instance::fromVertices(grid_, {0, 3}, {3, 5});
  EXPECT_TRUE(validate(whole, plan).empty());
}

TEST_F(Stitching, PlansBelongToPiecesByName) {
  const PieceTree tree = PieceTree::sequence(
      std::vector<PieceTree>{PieceTree::parallel({leaf(7, {4}, {5}, {1}), leaf(3, {0}, {2}, {0})}),
                             leaf(5, {2, 5}, {1, 4}, {0, 1})});
  const Plan plan = stitch(tree, {{3, {{{0, 1, 2}}}}, {5, {{{2, 1}, {5, 4}}}}, {7, {{{4, 5}}}}}, 2);
  EXPECT_EQ(plan.paths[0], (Path{0, 1, 2, 1}));
  EXPECT_EQ(plan.paths[1], (Path{4, 5, 5, 4}));
}

TEST_F(Stitching, PathsEndAtTheArrival) {
  const PieceTree tree = PieceTree::sequence(
      std::vector<PieceTree>{leaf(0, {0, 5}, {1, 4}, {0, 1}), leaf(1, {1, 4}, {1, 2}, {0, 1})});
  const Plan plan = stitch(tree, {{0, {{{0, 1}, {5, 4}}}}, {1, {{{1}, {4, 3, 2}}}}}, 2);
  EXPECT_EQ(plan.paths[0], (Path{0, 1}));
  EXPECT_EQ(plan.paths[1], (Path{5, 4, 3, 2}));
}

TEST_F(Stitching, APieceWithoutAPlanIsAnError) {
  EXPECT_THROW(stitch(leaf(4, {0}, {1}, {0}), {}, 1), std::out_of_range);
}

TEST_F(Stitching, PiecesComeFromLeftToRight) {
  const PieceTree tree = PieceTree::sequence(
      std::vector<PieceTree>{PieceTree::parallel({leaf(0, {0}, {0}, {0}), leaf(1, {1}, {1}, {1})}),
                             leaf(2, {0, 1}, {0, 1}, {0, 1})});
  const auto pieces = piecesOf(tree);
  ASSERT_EQ(pieces.size(), 3U);
  EXPECT_EQ(pieces[1]->robots, (std::vector<std::uint32_t>{1}));
}

}  // namespace
}  // namespace split_mapf
