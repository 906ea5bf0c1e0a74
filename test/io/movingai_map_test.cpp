#include <gtest/gtest.h>

#include "io/temporary_files.h"
#include "split_mapf/io/movingai.h"
#include "support/benchmarks.h"

namespace split_mapf {
namespace {

class MovingAiMapTest : public test::FileTest {
 protected:
  std::string errorOfMap(const std::string& text) const {
    const std::string path = file("a.map", text);
    return errorOf([&] { readMovingAiMap(path); });
  }
};

const std::string map_head = "type octile\nheight 2\nwidth 3\nmap\n";

TEST_F(MovingAiMapTest, ReadsEverySymbol) {
  const auto grid =
      readMovingAiMap(file("a.map", "type octile\nheight 2\nwidth 4\nmap\n.GSE\n@OTW\n"));
  EXPECT_EQ(grid->width(), 4U);
  EXPECT_EQ(grid->height(), 2U);
  for (int x = 0; x < 4; ++x) {
    EXPECT_TRUE(grid->isFree({x, 0})) << x;
    EXPECT_FALSE(grid->isFree({x, 1})) << x;
  }
}

TEST_F(MovingAiMapTest, TakesCarriageReturnsBlankEndAndMissingLastLineFeed) {
  const std::string windows = "type octile\r\nheight 1\r\nwidth 2\r\nmap\r\n.@\r\n\r\n  \r\n";
  EXPECT_EQ(readMovingAiMap(file("a.map", windows))->size(), 1U);
  EXPECT_EQ(readMovingAiMap(file("b.map", map_head + "...\n@@."))->size(), 4U);
}

TEST_F(MovingAiMapTest, RowsCountFromTheTop) {
  const auto grid = readMovingAiMap(file("a.map", map_head + "..@\n@@@\n"));
  EXPECT_TRUE(grid->isFree({1, 0}));
  EXPECT_FALSE(grid->isFree({2, 0}));
  EXPECT_FALSE(grid->isFree({0, 1}));
}

TEST_F(MovingAiMapTest, NamesTheFaultyHeaderLine) {
  EXPECT_EQ(errorOfMap(""),
            "a.map:1: read the end of the file, expected 'type octile' or 'height N' with N from 1 "
            "to 32768");
  EXPECT_EQ(errorOfMap("4,4\n"),
            "a.map:1: read '4,4', expected 'type octile' or 'height N' with N from 1 to 32768");
  EXPECT_EQ(errorOfMap("type tile\n"), "a.map:1: read 'type tile', expected 'type octile'");
  EXPECT_EQ(errorOfMap("type octile\nwidth 3\nmap\n"),
            "a.map:3: read 'map', expected 'height N' with N from 1 to 32768");
  EXPECT_EQ(errorOfMap("type octile\nheight 3\nwidth x\n"),
            "a.map:3: read 'width x', expected 'width N' with N from 1 to 32768");
  EXPECT_EQ(errorOfMap("type octile\nheight 0\n"),
            "a.map:2: read 'height 0', expected 'height N' with N from 1 to 32768");
  EXPECT_EQ(errorOfMap("type octile\nheight 32769\n"),
            "a.map:2: read 'height 32769', expected 'height N' with N from 1 to 32768");
  EXPECT_EQ(errorOfMap("type octile\nheight 99999999999999999999\n"),
            "a.map:2: read 'height 99999999999999999999', expected 'height N' with N from 1 to "
            "32768");
  EXPECT_EQ(errorOfMap("type octile\nheight 3 4\n"),
            "a.map:2: read 'height 3 4', expected 'height N' with N from 1 to 32768");
  EXPECT_EQ(errorOfMap("type octile\nheight 2\nwidth 3\n...\n"),
            "a.map:4: read '...', expected 'map'");
}

TEST_F(MovingAiMapTest, NamesTheFaultyRow) {
  EXPECT_EQ(errorOfMap(map_head + "...\n..\n"),
            "a.map:6: read 2 characters: '..', expected 3 characters in row 2 of 2, the map's "
            "width");
  EXPECT_EQ(errorOfMap(map_head + "....\n...\n"),
            "a.map:5: read 4 characters: '....', expected 3 characters in row 1 of 2, the map's "
            "width");
  EXPECT_EQ(errorOfMap(map_head + "...\n"),
            "a.map:6: read the end of the file, expected row 2 of 2");
  EXPECT_EQ(errorOfMap(map_head + "...\n.x.\n"),
            "a.map:6: read 'x' in column 2, expected one of '.GSE' (free) or '@OTW' (blocked)");
  EXPECT_EQ(errorOfMap(map_head + std::string("..\0\n", 4)),
            "a.map:5: read '\\x00' in column 3, expected one of '.GSE' (free) or '@OTW' (blocked)");
  EXPECT_EQ(errorOfMap(map_head + "...\n...\n...\n"),
            "a.map:7: read '...', expected the end of the file after 2 rows");
}

// Maps of the field that were refused.
class MapOfTheFieldTest : public MovingAiMapTest {
 protected:
  // Rows of '.' and '@' of what was read; what the refusal says else.
  std::string rowsOf(const std::string& text) const {
    std::shared_ptr<const Grid> grid;
    const std::string path = file("a.map", text);
    std::string error = errorOf([&] { grid = readMovingAiMap(path); });
    if (!grid) return error;
    std::string rows;
    for (int y = 0; y < static_cast<int>(grid->height()); ++y) {
      for (int x = 0; x < static_cast<int>(grid->width()); ++x) {
        rows += grid->isFree({x, y}) ? '.' : '@';
      }
      rows += '/';
    }
    return rows;
  }
};

TEST_F(MapOfTheFieldTest, ReadsHeadersInAnyOrderAndWithoutType) {
  EXPECT_EQ(rowsOf("height 2\nwidth 3\nmap\n...\n.@.\n"), ".../.@./");
  EXPECT_EQ(rowsOf("type octile\nwidth 3\nheight 2\nmap\n...\n.@.\n"), ".../.@./");
  EXPECT_EQ(rowsOf("width 3\nheight 2\ntype octile\nmap\n...\n.@.\n"), ".../.@./");
}

TEST_F(MapOfTheFieldTest, ReadsHeaderWordsInAnyCaseAndParting) {
  EXPECT_EQ(rowsOf("Type OCTILE\nHEIGHT 2\nWidth\t3\nMAP\n...\n.@.\n"), ".../.@./");
  EXPECT_EQ(rowsOf(" type  octile\nheight\t 2 \nwidth 3\t\nmap \n...\n.@.\n"), ".../.@./");
}

TEST_F(MapOfTheFieldTest, ReadsBlanksBehindRows) {
  EXPECT_EQ(rowsOf(map_head + "...  \n.@.\t\n"), ".../.@./");
  EXPECT_EQ(rowsOf(map_head + "... \r\n.@."), ".../.@./");
}

TEST_F(MapOfTheFieldTest, ReadsEmptyLines) {
  EXPECT_EQ(rowsOf("\ntype octile\n\nheight 2\nwidth 3\nmap\n\n...\n\n.@.\n\n \n"), ".../.@./");
  EXPECT_EQ(rowsOf(map_head + "...\n\n"), "a.map:6: read an empty line, expected row 2 of 2");
}

TEST_F(MapOfTheFieldTest, ReadsEveryLineEndAndAByteOrderMark) {
  EXPECT_EQ(rowsOf("\xef\xbb\xbf" + map_head + "...\n.@.\n"), ".../.@./");
  EXPECT_EQ(rowsOf("height 2\rwidth 3\rmap\r...\r.@.\r"), ".../.@./");
  EXPECT_EQ(rowsOf("height 2\r\nwidth 3\r\nmap\r\n...\r\n.@.\r\n"), ".../.@./");
}

TEST_F(MapOfTheFieldTest, TakesEmittersAndServicePointsAsFree) {
  EXPECT_EQ(rowsOf(map_head + ".ES\n@E.\n"), ".../@../");
}

TEST_F(MapOfTheFieldTest, RefusesASecondMapAtItsFirstLine) {
  const std::string map = map_head + "...\n.@.\n";
  EXPECT_EQ(rowsOf(map + "\n" + map),
            "a.map:8: read 'type octile', a second map, expected the end of the file after 2 rows");
  EXPECT_EQ(rowsOf(map + "height 2\nwidth 3\nmap\n...\n.@.\n"),
            "a.map:7: read 'height 2', a second map, expected the end of the file after 2 rows");
  EXPECT_EQ(rowsOf(map + "\n\n...\n"),
            "a.map:9: read '...', expected the end of the file after 2 rows");
}

TEST_F(MapOfTheFieldTest, RefusesAHeaderThatSaysThingsTwice) {
  EXPECT_EQ(rowsOf("height 2\nheight 3\n"),
            "a.map:2: read 'height 3' a second time, expected 'width N' with N from 1 to 32768");
  EXPECT_EQ(rowsOf("type octile\ntype octile\n"),
            "a.map:2: read 'type octile' a second time, expected 'height N' with N from 1 to "
            "32768");
}

TEST_F(MapOfTheFieldTest, RefusesBlanksThatCouldBeCells) {
  EXPECT_EQ(rowsOf(map_head + ". .\n.@.\n").substr(0, 28), "a.map:5: read ' ' in column ");
  EXPECT_EQ(rowsOf(map_head + " ..\n.@.\n").substr(0, 28), "a.map:5: read ' ' in column ");
  EXPECT_EQ(rowsOf(map_head + ".. \n.@.\n").substr(0, 28), "a.map:5: read 2 characters: ");
}

TEST_F(MovingAiMapTest, NamesAFileThatCannotBeRead) {
  EXPECT_EQ(errorOf([&] { readMovingAiMap(pathOf("none.map")); }),
            "cannot open none.map: No such file or directory");
  EXPECT_EQ(errorOf([&] { readMovingAiMap(pathOf("")); }).find("cannot read "), 0U);
}

TEST_F(MovingAiMapTest, WritesWhatItReads) {
  const auto grid = readMovingAiMap(file("a.map", map_head + "..@\nGTS\n"));
  writeMovingAiMap(pathOf("b.map"), *grid);
  EXPECT_EQ(contentOf(pathOf("b.map")), map_head + "..@\n.@.\n");
  EXPECT_EQ(errorOf([&] { writeMovingAiMap(pathOf("no/b.map"), *grid); }),
            "cannot write no/b.map: No such file or directory");
}

TEST_F(MovingAiMapTest, ReadsBenchmarks) {
  const std::string name = "movingai/brc202d.map";
  const auto path = test::benchmarkFile(name);
  if (!path) GTEST_SKIP() << test::benchmarkMissing(name);
  const auto grid = readMovingAiMap(*path);
  EXPECT_EQ(grid->width(), 530U);
  EXPECT_EQ(grid->height(), 481U);
  EXPECT_EQ(grid->size(), 43151U);
}

}  // namespace
}  // namespace split_mapf
