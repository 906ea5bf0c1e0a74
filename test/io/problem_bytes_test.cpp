#include "split_mapf/io/problem_bytes.h"

#include <gtest/gtest.h>

#include <string>

#include "split_mapf/core/error.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

Problem small() { return {test::gridFromAscii({"..#", "..."}), {0, 4}, {3, 1}}; }

std::string faultOf(const std::string& bytes) {
  try {
    problemFromBytes(bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ProblemBytes, ComeBackAsTheyWere) {
  const Problem problem = small();
  const Problem read = problemFromBytes(toBytes(problem));
  EXPECT_EQ(read.starts, problem.starts);
  EXPECT_EQ(read.goals, problem.goals);
  EXPECT_EQ(read.grid->width(), 3U);
  EXPECT_EQ(read.grid->height(), 2U);
  EXPECT_EQ(read.grid->size(), 5U);
  EXPECT_FALSE(read.grid->isFree({2, 0}));
  EXPECT_TRUE(read.grid->hasUnitMoves());
}

TEST(ProblemBytes, AreTheSameEverywhere) {
  EXPECT_EQ(toBytes(small()), std::string("MAPF1\x00\x03\x02\x3b\x02\x00\x04\x02\x03\x01", 15));
}

TEST(ProblemBytes, KeepThePlacesAndEdgesOfAPlanningGraph) {
  const auto grid =
      std::make_shared<const Grid>(4, 3, std::vector<std::uint32_t>{0, 3, 10},
                                   std::vector<std::pair<Vertex, Vertex>>{{0, 1}, {1, 2}});
  const Problem read = problemFromBytes(toBytes({grid, {0}, {2}}));
  ASSERT_FALSE(read.grid->hasUnitMoves());
  EXPECT_EQ(read.grid->cellOf(2), (Cell{2, 2}));
  EXPECT_EQ(read.grid->longestMove(), grid->longestMove());
  EXPECT_TRUE(read.grid->graph().adjacent(1, 2));
  EXPECT_FALSE(read.grid->graph().adjacent(0, 2));
}

TEST(ProblemBytes, SayWhatIsWrong) {
  const std::string bytes = toBytes(small());
  EXPECT_EQ(faultOf("plan"), "problem: byte 0: 'MAPF1' is expected");
  EXPECT_EQ(faultOf(bytes.substr(0, 7)),
            "problem: byte 7: the bytes end where the height is expected");
  EXPECT_EQ(faultOf(bytes.substr(0, 8)),
            "problem: byte 8: 6 cells are expected, but only 0 bytes follow");
  EXPECT_EQ(faultOf(bytes + "x"), "problem: byte 15: 1 byte more than expected");
  std::string wrong = bytes;
  wrong[5] = 2;
  EXPECT_EQ(faultOf(wrong), "problem: byte 5: the kind of the grid is 2, at most 1 is expected");
  wrong = bytes;
  wrong[11] = 5;
  EXPECT_EQ(faultOf(wrong), "problem: byte 11: start is 5, at most 4 is expected");
  wrong = bytes;
  wrong[9] = 100;
  EXPECT_EQ(faultOf(wrong),
            "problem: byte 10: the number of starts is 100, but only 5 bytes follow");
  // A map of the greatest size needs its bytes before it gets memory.
  EXPECT_EQ(faultOf(std::string("MAPF1\x00\x80\x80\x02\x80\x80\x02", 12)),
            "problem: byte 12: 1073741824 cells are expected, but only 0 bytes follow");
}

}  // namespace
}  // namespace split_mapf
