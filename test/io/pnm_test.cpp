#include <gtest/gtest.h>

#include "io/map_picture.h"
#include "io/temporary_files.h"

namespace split_mapf {
namespace {

class PnmTest : public test::FileTest {
 protected:
  static std::vector<float> valuesOf(const std::string& bytes) {
    return parsePnm("a.pgm", bytes).brightness;
  }
  std::string errorOfPnm(const std::string& bytes) const {
    return errorOf([&] { parsePnm("a.pgm", bytes); });
  }
};

using Values = std::vector<float>;

TEST_F(PnmTest, ReadsPlain) {
  const MapPicture picture = parsePnm("a.pgm", "P2\n3 2\n255\n0 1 2\n253 254 255\n");
  EXPECT_EQ(picture.width, 3U);
  EXPECT_EQ(picture.height, 2U);
  EXPECT_EQ(picture.brightness, (Values{0, 1, 2, 253, 254, 255}));
  EXPECT_TRUE(picture.alpha.empty());
}

TEST_F(PnmTest, ReadsBinary) {
  EXPECT_EQ(valuesOf(std::string("P5\n2 1\n255\n\x00\xcd", 13)), (Values{0, 205}));
}

TEST_F(PnmTest, TakesABlankAsFirstSample) {
  EXPECT_EQ(valuesOf("P5 2 1 255\n\n "), (Values{10, 32}));
}

TEST_F(PnmTest, ScalesByMaxval) {
  EXPECT_EQ(valuesOf("P2 3 1 1 0 1 1"), (Values{0, 255, 255}));
  EXPECT_EQ(valuesOf("P2 3 1 510 0 2 510"), (Values{0, 1, 255}));
  EXPECT_EQ(valuesOf(std::string("P5 2 1 5 \x01\x05", 11)), (Values{51, 255}));
}

TEST_F(PnmTest, ReadsSixteenBitsHighByteFirst) {
  EXPECT_EQ(valuesOf(std::string("P5 3 1 65535 \x00\x00\x01\x01\xff\xff", 19)),
            (Values{0, 1, 255}));
  EXPECT_EQ(valuesOf(std::string("P5 1 1 256 \x01\x00", 13)), (Values{255}));
}

TEST_F(PnmTest, SkipsComments) {
  EXPECT_EQ(valuesOf("P2# one\n#two\n 2 # three\n1\n#four\n9 9#five 5\n 0 # six"),
            (Values{255, 0}));
  EXPECT_EQ(valuesOf("P5\n# CREATOR: somebody\n1 1\n255\n#"), (Values{35}));
}

TEST_F(PnmTest, NamesTheLineOfPlainFiles) {
  EXPECT_EQ(errorOfPnm("P2\nx 1\n"), "a.pgm:2: read 'x', expected the width, 1 to 32768");
  EXPECT_EQ(errorOfPnm("P2\n2\n"),
            "a.pgm:3: read the end of the file, expected the height, 1 to 32768");
  EXPECT_EQ(errorOfPnm("P2\n0 1\n"), "a.pgm:2: read '0', expected the width, 1 to 32768");
  EXPECT_EQ(errorOfPnm("P2\n99999999999 1\n"),
            "a.pgm:2: read '99999999999', expected the width, 1 to 32768");
  EXPECT_EQ(errorOfPnm("P2\n2 1\n65536\n"),
            "a.pgm:3: read '65536', expected the maximum value, 1 to 65535");
  EXPECT_EQ(errorOfPnm("P2\n2 1\n0\n"),
            "a.pgm:3: read '0', expected the maximum value, 1 to 65535");
  EXPECT_EQ(errorOfPnm("P2\n2 2\n255\n1 2\n3\n"),
            "a.pgm:6: read the end of the file, expected sample 4 of 4, 0 to 255");
  EXPECT_EQ(errorOfPnm("P2\n2 2\n255\n1 2\n# \n3 256\n"),
            "a.pgm:6: read '256', expected sample 4 of 4, 0 to 255");
  EXPECT_EQ(errorOfPnm("P2\n2 1\n255\n1 -2\n"),
            "a.pgm:4: read '-2', expected sample 2 of 2, 0 to 255");
  EXPECT_EQ(errorOfPnm("P2\n2 1\n255\n1 2x\n"),
            "a.pgm:4: read '2x', expected sample 2 of 2, 0 to 255");
  EXPECT_EQ(errorOfPnm("P2\n2 1\n255\n1 2\n3\n"),
            "a.pgm:5: read '3', expected the end of the file after 2 samples");
}

TEST_F(PnmTest, NamesTheByteOfBinaryFiles) {
  EXPECT_EQ(errorOfPnm("P5\n2 1.5\n"),
            "a.pgm: byte 5: read '1.5', expected the height, 1 to 32768");
  EXPECT_EQ(errorOfPnm("P5 2 1 255"),
            "a.pgm: byte 10: read the end of the file, expected one white space and the samples");
  EXPECT_EQ(errorOfPnm("P5 2 1 255#\nab"),
            "a.pgm: byte 10: read '#', expected one white space and the samples");
  EXPECT_EQ(errorOfPnm("P5 2 2 255 abc"),
            "a.pgm: byte 14: read the end of the file after 3 bytes of samples, expected 4");
  EXPECT_EQ(errorOfPnm("P5 2 2 256 abc"),
            "a.pgm: byte 14: read the end of the file after 3 bytes of samples, expected 8");
  EXPECT_EQ(errorOfPnm("P5 32768 32768 255 a"),
            "a.pgm: byte 20: read the end of the file after 1 bytes of samples, expected "
            "1073741824");
  EXPECT_EQ(errorOfPnm("P5 2 1 255 abc"),
            "a.pgm: byte 13: read 1 more byte, expected the end of the file after 2 bytes of "
            "samples");
  EXPECT_EQ(
      errorOfPnm("P5\n2 1\n255\r\nab"),
      "a.pgm: byte 11: read CR LF and 2 bytes, expected one white space and 2 bytes of samples");
  EXPECT_EQ(errorOfPnm("P5 2 1 9 \x01\x0a"),
            "a.pgm: byte 10: read sample 10, expected at most the maximum value 9");
}

TEST_F(PnmTest, ReadsALastNewLine) {
  EXPECT_EQ(valuesOf("P5 2 1 255 ab\n"), (Values{97, 98}));
  EXPECT_EQ(valuesOf("P5 2 1 255 ab\r\n"), (Values{97, 98}));
  EXPECT_EQ(valuesOf("P5 2 1 255 a\n\n"), (Values{97, 10}));
  EXPECT_EQ(valuesOf(std::string("P5 1 1 65535 \x01\x01\n", 16)), (Values{1}));
}

TEST_F(PnmTest, RefusesASecondPicture) {
  EXPECT_EQ(errorOfPnm("P5 2 1 255 ab\nP5 2 1 255 ab"),
            "a.pgm: byte 14: read 14 more bytes, expected the end of the file after 2 bytes of "
            "samples");
}

TEST_F(PnmTest, TakesCarriageReturnsInTheHeader) {
  EXPECT_EQ(valuesOf("P5\r\n2 1\r\n255\nab"), (Values{97, 98}));
  EXPECT_EQ(valuesOf("P2\r\n# one\r\n2 1\r\n255\r\n0 255\r\n"), (Values{0, 255}));
}

TEST_F(PnmTest, NamesAnotherKindOfFile) {
  EXPECT_EQ(errorOfPnm("P7 1 1 255 abc"), "a.pgm: byte 0: read 'P7', expected 'P1' to 'P6'");
  EXPECT_EQ(errorOfPnm("P25 1 1 255"), "a.pgm:1: read 'P25', expected 'P2' and white space");
  EXPECT_EQ(errorOfPnm(""), "a.pgm: byte 0: read '', expected 'P1' to 'P6'");
}

TEST_F(PnmTest, ReadsBitmaps) {
  EXPECT_EQ(valuesOf("P1\n# one\n3 2\n1 0 1\n011\n"), (Values{0, 255, 0, 255, 0, 0}));
  EXPECT_EQ(
      valuesOf(std::string("P4\n9 2\n\x80\x80\x01\x00\n", 12)),
      (Values{0, 255, 255, 255, 255, 255, 255, 255, 0, 255, 255, 255, 255, 255, 255, 255, 0, 255}));
  EXPECT_EQ(errorOfPnm("P1\n2 1\n0 2\n"), "a.pgm:3: read '2', expected sample 2 of 2, 0 or 1");
  EXPECT_EQ(errorOfPnm("P1\n2 1\n0"),
            "a.pgm:3: read the end of the file, expected sample 2 of 2, 0 or 1");
  EXPECT_EQ(errorOfPnm("P4 9 2 abc"),
            "a.pgm: byte 10: read the end of the file after 3 bytes of samples, expected 4");
}

TEST_F(PnmTest, AveragesColours) {
  EXPECT_EQ(valuesOf("P3\n2 1\n255\n10 20 30  255 0 0\n"), (Values{20, 85}));
  EXPECT_EQ(valuesOf("P6 1 1 255 \n\n\n"), (Values{10}));
  EXPECT_EQ(errorOfPnm("P6 1 1 255 ab"),
            "a.pgm: byte 13: read the end of the file after 2 bytes of samples, expected 3");
}

}  // namespace
}  // namespace split_mapf
