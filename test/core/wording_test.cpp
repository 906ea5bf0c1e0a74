#include "split_mapf/core/wording.h"

#include <gtest/gtest.h>

namespace split_mapf {
namespace {

TEST(Shown, LeavesAShortTextAsItIs) {
  EXPECT_EQ(shown(""), "");
  EXPECT_EQ(shown("dock 3"), "dock 3");
  EXPECT_EQ(quote("M\xc3\xbcller \xe6\x9c\xba\xe5\x99\xa8"),
            "'M\xc3\xbcller \xe6\x9c\xba\xe5\x99\xa8'");
  EXPECT_EQ(shown(std::string(80, 'a')), std::string(80, 'a'));
}

TEST(Shown, CutsAMillionBytesToEightyCharacters) {
  EXPECT_EQ(shown(std::string(1000000, 'a')), std::string(77, 'a') + "...");
}

TEST(Shown, NeverCutsInsideACharacter) {
  std::string snowmen;
  for (int i = 0; i < 81; ++i) snowmen += "\xe2\x98\x83";
  const std::string text = shown(snowmen);
  EXPECT_EQ(text.size(), std::size_t{77} * 3 + 3);
  EXPECT_EQ(text.substr(0, std::size_t{77} * 3), snowmen.substr(0, std::size_t{77} * 3));
}

TEST(Shown, EscapesWhatWouldSpoilATerminal) {
  EXPECT_EQ(shown("a\nb\tc\x1b[31m\x7f"), "a\\x0ab\\x09c\\x1b[31m\\x7f");
  EXPECT_EQ(shown(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(shown("\xc2\x9b"), "\\xc2\\x9b");  // a C1 control
  EXPECT_EQ(shown("\xe2\x80\xae"
                  "abc"),
            "\\xe2\\x80\\xae"
            "abc");  // right-to-left override
  EXPECT_EQ(shown("\xef\xbb\xbfmap"), "\\xef\\xbb\\xbfmap");
}

TEST(Shown, EscapesBytesThatAreNoUtf8) {
  EXPECT_EQ(shown("\xff\xfe"), "\\xff\\xfe");
  EXPECT_EQ(shown("\xc3"), "\\xc3");
  EXPECT_EQ(shown("\xc0\x80"), "\\xc0\\x80");           // overlong
  EXPECT_EQ(shown("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // a surrogate
  EXPECT_EQ(shown("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");
  EXPECT_EQ(shown(std::string(100, '\xff')).size(), 4U * 19 + 3);
}

TEST(IsUtf8, LooksAtEveryByte) {
  EXPECT_TRUE(isUtf8(""));
  EXPECT_TRUE(isUtf8("M\xc3\xbcller"));
  EXPECT_FALSE(isUtf8("M\xfcller"));
  EXPECT_FALSE(isUtf8("r\xc3"));
  EXPECT_FALSE(isUtf8(std::string(1000, 'a') + "\xff"));
}

TEST(Counted, AgreesWithTheNumber) {
  EXPECT_EQ(counted(0, "robot"), "0 robots");
  EXPECT_EQ(counted(1, "robot"), "1 robot");
  EXPECT_EQ(counted(2, "robot"), "2 robots");
  EXPECT_EQ(counted(1, "more byte"), "1 more byte");
  EXPECT_EQ(counted(3, "entry", "entries"), "3 entries");
}

TEST(Numeral, IsShortHoweverGreatTheNumber) {
  EXPECT_EQ(numeral(0.5), "0.5");
  EXPECT_EQ(numeral(60), "60");
  EXPECT_EQ(numeral(1e300), "1e+300");
  EXPECT_EQ(numeral(5e-324), "4.94066e-324");
}

}  // namespace
}  // namespace split_mapf
