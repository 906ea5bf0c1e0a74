#include <gtest/gtest.h>

#include "io/temporary_files.h"
#include "split_mapf/io/movingai.h"
#include "support/benchmarks.h"

namespace split_mapf {
namespace {

// Three by two, with the cell (2,0) blocked.
const Grid small_grid(3, 2, {true, true, false, true, true, true});
const std::string version_line = "version 1\n";
const std::string good_row = "0\ta.map\t3\t2\t0\t0\t2\t1\t3.4142\n";

class ScenarioTest : public test::FileTest {
 protected:
  std::string errorOfScenario(const std::string& text,
                              std::optional<std::uint32_t> agents = std::nullopt) const {
    const std::string path = file("a.scen", text);
    return errorOf([&] { readMovingAiScenario(path, small_grid, agents); });
  }
};

TEST_F(ScenarioTest, ReadsAllRows) {
  const std::string path =
      file("a.scen", version_line + good_row + "1\tother.map\t3\t2\t1\t0\t0\t1\t2\n\n");
  const Scenario scenario = readMovingAiScenario(path, small_grid);
  EXPECT_EQ(scenario.starts, (std::vector<Cell>{{0, 0}, {1, 0}}));
  EXPECT_EQ(scenario.goals, (std::vector<Cell>{{2, 1}, {0, 1}}));
}

TEST_F(ScenarioTest, ReadsTheFirstRowsAndNoMore) {
  const std::string path =
      file("a.scen", version_line + good_row + "this row is never looked at\n");
  EXPECT_EQ(readMovingAiScenario(path, small_grid, 1).starts.size(), 1U);
}

TEST_F(ScenarioTest, TakesCarriageReturnsBlanksAndVersionWithPoint) {
  const std::string path = file("a.scen", "version 1.0\r\n0 a.map 3 2 0 0 2 1 3\r\n");
  EXPECT_EQ(readMovingAiScenario(path, small_grid).goals, (std::vector<Cell>{{2, 1}}));
}

TEST_F(ScenarioTest, TakesAMapNameWithBlanks) {
  const std::string path = file("a.scen", version_line + "0\tmy own.map\t3\t2\t0\t0\t2\t1\t3\n");
  EXPECT_EQ(readMovingAiScenario(path, small_grid).starts.size(), 1U);
}

TEST_F(ScenarioTest, NeedsTheVersion) {
  EXPECT_EQ(errorOfScenario(""), "a.scen:1: read the end of the file, expected 'version 1'");
  EXPECT_EQ(
      errorOfScenario("0\ta.map\t0\t0\t2\t1\t3.4142\n"),
      "a.scen:1: read '0\\x09a.map\\x090\\x090\\x092\\x091\\x093.4142', expected 'version 1'");
  EXPECT_EQ(errorOfScenario("version 2\n"), "a.scen:1: read 'version 2', expected 'version 1'");
}

TEST_F(ScenarioTest, NeedsEnoughRows) {
  EXPECT_EQ(errorOfScenario(version_line + good_row, 2),
            "a.scen:3: read the end of the file after 1 robot, expected 2 robots");
  EXPECT_EQ(errorOfScenario(version_line + "\n", 2),
            "a.scen:3: read the end of the file after 0 robots, expected 2 robots");
  EXPECT_EQ(errorOfScenario(version_line),
            "a.scen:2: read the end of the file after 0 robots, expected at least one");
  EXPECT_EQ(errorOfScenario(version_line + good_row, 0),
            "0 robots asked of a.scen, expected 1 or more");
}

TEST_F(ScenarioTest, NeedsWellFormedRows) {
  EXPECT_EQ(
      errorOfScenario(version_line + "0\ta.map\t3\t2\t0\t0\t2\n"),
      "a.scen:2: read 7 columns: '0\\x09a.map\\x093\\x092\\x090\\x090\\x092', expected 9 columns: "
      "bucket, map, width, height, start x, start y, goal x, goal y, length");
  EXPECT_EQ(errorOfScenario(version_line + "0 a.map 3 2 0 0 2 1 3 4\n").substr(0, 25),
            "a.scen:2: read 10 columns");
  EXPECT_EQ(errorOfScenario(version_line + "\n0\ta.map\t3\t2\t0\t0\t2\t1\t3\t4\n").substr(0, 25),
            "a.scen:3: read 10 columns");
  EXPECT_EQ(errorOfScenario(version_line + "b\ta.map\t3\t2\t0\t0\t2\t1\t3\n"),
            "a.scen:2: read 'b', expected an integer as bucket");
  EXPECT_EQ(errorOfScenario(version_line + "0\ta.map\t3\t2\t0\t0.5\t2\t1\t3\n"),
            "a.scen:2: read '0.5', expected an integer as robot 0: start y");
  EXPECT_EQ(
      errorOfScenario(version_line + "0\ta.map\t3\t2\t0\t0\t2\t\t3\n"),
      "a.scen:2: read 8 columns: '0\\x09a.map\\x093\\x092\\x090\\x090\\x092\\x09\\x093', expected "
      "9 columns: bucket, map, width, height, start x, start y, goal x, goal y, length");
  EXPECT_EQ(errorOfScenario(version_line + "0\ta.map\t3\t2\t0\t0\t2\t1\tlong\n"),
            "a.scen:2: read 'long', expected a number as length");
}

// Scenarios of the field that were refused.
class ScenarioOfTheFieldTest : public ScenarioTest {
 protected:
  // "start>goal" of every robot; what the refusal says else.
  std::string waysOf(const std::string& text) const {
    Scenario scenario;
    const std::string path = file("a.scen", text);
    std::string error = errorOf([&] { scenario = readMovingAiScenario(path, small_grid); });
    if (!error.empty()) return error;
    std::string ways;
    for (std::size_t i = 0; i < scenario.starts.size(); ++i) {
      ways += toString(scenario.starts[i]) + ">" + toString(scenario.goals[i]) + " ";
    }
    return ways;
  }
};

TEST_F(ScenarioOfTheFieldTest, ReadsBlanksAtTheEndOfARow) {
  EXPECT_EQ(waysOf(version_line + "0\ta.map\t3\t2\t0\t0\t2\t1\t3 \n"), "(0,0)>(2,1) ");
  EXPECT_EQ(waysOf(version_line + "0\ta.map\t3\t2\t0\t0\t2\t1\t3.5\t\n"), "(0,0)>(2,1) ");
  EXPECT_EQ(waysOf(version_line + "0\ta.map \t 3\t2\t 0\t0 \t2\t1\t3\n"), "(0,0)>(2,1) ");
}

TEST_F(ScenarioOfTheFieldTest, ReadsEmptyLines) {
  EXPECT_EQ(waysOf("\nversion 1\n\n" + good_row + "  \n" + good_row + "\n"),
            "(0,0)>(2,1) (0,0)>(2,1) ");
}

TEST_F(ScenarioOfTheFieldTest, ReadsSeveralTabs) {
  EXPECT_EQ(waysOf(version_line + "0\t\ta.map\t\t3\t2\t0\t0\t2\t1\t3\n"), "(0,0)>(2,1) ");
}

TEST_F(ScenarioOfTheFieldTest, ReadsTabsAmongBlanks) {
  EXPECT_EQ(waysOf(version_line + "0 a.map\t3 2\t0 0\t2  1\t3\n"), "(0,0)>(2,1) ");
}

TEST_F(ScenarioOfTheFieldTest, ReadsNamesWithBlanksAndOtherLetters) {
  EXPECT_EQ(waysOf(version_line + "0 my own town.map 3 2 0 0 2 1 3\n"), "(0,0)>(2,1) ");
  EXPECT_EQ(waysOf(version_line + "0\tmy town.map\t3\t2\t0\t0\t2\t1\t3\n"), "(0,0)>(2,1) ");
  EXPECT_EQ(waysOf(version_line + "0\tK\xc3\xb6ln.map\t3\t2\t0\t0\t2\t1\t3\n"), "(0,0)>(2,1) ");
}

TEST_F(ScenarioOfTheFieldTest, ReadsEveryLineEndAndAByteOrderMark) {
  EXPECT_EQ(waysOf("\xef\xbb\xbfversion 1\r\n0\ta.map\t3\t2\t0\t0\t2\t1\t3\r\n"), "(0,0)>(2,1) ");
  EXPECT_EQ(waysOf("version 1\r0\ta.map\t3\t2\t0\t0\t2\t1\t3\r"), "(0,0)>(2,1) ");
}

TEST_F(ScenarioOfTheFieldTest, ReadsRowsWithoutAVersion) {
  EXPECT_EQ(waysOf(good_row + good_row), "(0,0)>(2,1) (0,0)>(2,1) ");
  EXPECT_EQ(waysOf("VERSION\t1.0\n" + good_row), "(0,0)>(2,1) ");
}

TEST_F(ScenarioOfTheFieldTest, ReadsRowsWithoutALength) {
  EXPECT_EQ(waysOf(version_line + "0\tmy town.map\t3\t2\t0\t0\t2\t1\n"), "(0,0)>(2,1) ");
  EXPECT_EQ(waysOf(version_line + "0 a.map 3 2 0 0 2 1\n"), "(0,0)>(2,1) ");
  EXPECT_EQ(waysOf(version_line + "0 a.map 3 2 0 0 2 1 inf\n"), "(0,0)>(2,1) ");
}

TEST_F(ScenarioOfTheFieldTest, RefusesAMissingColumnThatTwoTabsHide) {
  EXPECT_EQ(waysOf(version_line + "0\ta.map\t3\t2\t0\t\t2\t1\t3\n").substr(0, 24),
            "a.scen:2: read 8 columns");
}

TEST_F(ScenarioTest, NeedsTheSizeOfTheMap) {
  EXPECT_EQ(errorOfScenario(version_line + good_row + "0\ta.map\t3\t3\t0\t0\t2\t1\t3\n"),
            "a.scen:3: read a map of 3x3, expected the map's own size, 3x2");
}

TEST_F(ScenarioTest, NeedsNoMoreOfAMapThanItsSize) {
  const std::string path = file("a.scen", version_line + "0\ta.map\t3\t2\t2\t0\t0\t1\t3\n");
  EXPECT_EQ(readMovingAiScenario(path, MapSize{3, 2}).starts, (std::vector<Cell>{{2, 0}}));
  EXPECT_EQ(errorOf([&] {
              readMovingAiScenario(path, MapSize{2, 3});
            }),
            "a.scen:2: read a map of 3x2, expected the map's own size, 2x3");
}

TEST_F(ScenarioTest, NamesRobotAndCellAtFault) {
  EXPECT_EQ(errorOfScenario(version_line + good_row + "0\ta.map\t3\t2\t2\t0\t2\t1\t3\n"),
            "a.scen:3: robot 1: start (2,0) is blocked, expected a free cell");
  EXPECT_EQ(errorOfScenario(version_line + "0\ta.map\t3\t2\t0\t0\t2\t0\t3\n"),
            "a.scen:2: robot 0: goal (2,0) is blocked, expected a free cell");
  EXPECT_EQ(
      errorOfScenario(version_line + "0\ta.map\t3\t2\t3\t0\t2\t1\t3\n"),
      "a.scen:2: robot 0: start (3,0) is outside the map, expected a free cell of the 3x2 map");
  EXPECT_EQ(
      errorOfScenario(version_line + "0\ta.map\t3\t2\t0\t0\t-1\t1\t3\n"),
      "a.scen:2: robot 0: goal (-1,1) is outside the map, expected a free cell of the 3x2 map");
  EXPECT_EQ(errorOfScenario(version_line + "0\ta.map\t3\t2\t4294967296\t0\t2\t1\t3\n"),
            "a.scen:2: robot 0: start (4294967296,0) is outside the map, expected a free cell of "
            "the 3x2 map");
}

TEST_F(ScenarioTest, WritesWhatItReads) {
  const Scenario scenario{{{0, 0}, {1, 0}}, {{2, 1}, {1, 0}}};
  writeMovingAiScenario(pathOf("b.scen"), "a.map", small_grid, scenario);
  EXPECT_EQ(contentOf(pathOf("b.scen")),
            "version 1\n0\ta.map\t3\t2\t0\t0\t2\t1\t3\n0\ta.map\t3\t2\t1\t0\t1\t0\t0\n");
  const Scenario again = readMovingAiScenario(pathOf("b.scen"), small_grid);
  EXPECT_EQ(again.starts, scenario.starts);
  EXPECT_EQ(again.goals, scenario.goals);
}

TEST_F(ScenarioTest, WritesAnUnreachableGoalAsMinusOne) {
  const Grid islands(3, 1, {true, false, true});
  writeMovingAiScenario(pathOf("b.scen"), "a.map", islands, {{{0, 0}}, {{2, 0}}});
  EXPECT_EQ(contentOf(pathOf("b.scen")), "version 1\n0\ta.map\t3\t1\t0\t0\t2\t0\t-1\n");
  EXPECT_EQ(readMovingAiScenario(pathOf("b.scen"), islands).starts.size(), 1U);
}

TEST_F(ScenarioTest, RefusesToWriteWhatCannotBeRead) {
  const auto write = [&](const Scenario& scenario) {
    return errorOf([&] { writeMovingAiScenario(pathOf("b.scen"), "a.map", small_grid, scenario); });
  };
  EXPECT_EQ(write({{{2, 0}}, {{0, 0}}}),
            "robot 0: start (2,0) is blocked, expected a free cell of the 3x2 grid");
  EXPECT_EQ(write({{{0, 0}}, {{0, 2}}}),
            "robot 0: goal (0,2) is outside the map, expected a free cell of the 3x2 grid");
  EXPECT_EQ(write({{{0, 0}}, {}}), "a scenario of 1 start has 0 goals, expected as many");
}

TEST_F(ScenarioTest, ReadsBenchmarks) {
  for (const std::string name : {"movingai/brc202d", "movingai/Berlin_1_256"}) {
    const auto map = test::benchmarkFile(name + ".map");
    const auto scen = test::benchmarkFile(name + "-random-1.scen");
    if (!map || !scen) GTEST_SKIP() << test::benchmarkMissing(name);
    EXPECT_EQ(readMovingAiScenario(*scen, *readMovingAiMap(*map)).starts.size(), 1000U);
  }
}

}  // namespace
}  // namespace split_mapf
