#include <gtest/gtest.h>

#include "io/map_picture.h"
#include "io/png_builder.h"
#include "io/temporary_files.h"

namespace split_mapf {
namespace {

using test::PngBuilder;
using test::pngChunk;
using Values = std::vector<float>;

// A byte string with zeros inside.
template <std::size_t N>
std::string raw(const char (&text)[N]) {
  return {text, N - 1};
}

PngBuilder builder(std::uint32_t width, std::uint32_t height, int bit_depth, int colour_type,
                   const std::string& rows) {
  PngBuilder png;
  png.width = width;
  png.height = height;
  png.bit_depth = static_cast<char>(bit_depth);
  png.colour_type = static_cast<char>(colour_type);
  png.rows = rows;
  return png;
}

MapPicture read(const PngBuilder& png) { return parsePng("a.png", png.bytes()); }

void expectNear(const Values& actual, const Values& expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) EXPECT_NEAR(actual[i], expected[i], 1e-3) << i;
}

TEST(PngTest, ReadsGrey) {
  const MapPicture picture = read(builder(2, 2, 8, 0, raw("\0\x00\xcd\0\xff\x01")));
  EXPECT_EQ(picture.width, 2U);
  EXPECT_EQ(picture.height, 2U);
  EXPECT_EQ(picture.brightness, (Values{0, 205, 255, 1}));
  EXPECT_TRUE(picture.alpha.empty());
}

TEST(PngTest, ReadsGreyOfEveryDepth) {
  expectNear(read(builder(3, 1, 1, 0, raw("\0\xa0"))).brightness, {255, 0, 255});
  expectNear(read(builder(4, 1, 2, 0, raw("\0\x1b"))).brightness, {0, 85, 170, 255});
  expectNear(read(builder(3, 1, 4, 0, raw("\0\x0f\x10"))).brightness, {0, 255, 17});
  expectNear(read(builder(3, 1, 16, 0, raw("\0\x00\x00\x80\x00\xff\xff"))).brightness,
             {0, 32768 / 257.0F, 255});
}

TEST(PngTest, AveragesColours) {
  const MapPicture picture = read(builder(2, 1, 8, 2, raw("\0\x0a\x14\x1e\xff\x00\x00")));
  expectNear(picture.brightness, {20, 85});
  EXPECT_TRUE(picture.alpha.empty());
  expectNear(read(builder(1, 1, 16, 2, raw("\0\x01\x01\x02\x02\x03\x03"))).brightness, {2});
}

TEST(PngTest, ReadsAlpha) {
  const MapPicture grey = read(builder(2, 1, 8, 4, raw("\0\xc8\xff\x64\x00")));
  expectNear(grey.brightness, {200, 100});
  expectNear(grey.alpha, {255, 0});
  const MapPicture colour = read(builder(1, 1, 8, 6, raw("\0\x0a\x14\x1e\x80")));
  expectNear(colour.brightness, {20});
  expectNear(colour.alpha, {128});
  const MapPicture deep = read(builder(1, 1, 16, 4, raw("\0\x64\x64\x32\x32")));
  expectNear(deep.brightness, {100});
  expectNear(deep.alpha, {50});
  const MapPicture wide = read(builder(1, 1, 16, 6, raw("\0\x0a\x0a\x14\x14\x1e\x1e\xff\xff")));
  expectNear(wide.brightness, {20});
  expectNear(wide.alpha, {255});
}

TEST(PngTest, ReadsPalette) {
  PngBuilder png = builder(3, 1, 2, 3, raw("\0\x18"));  // entries 0, 1, 2
  png.extra = pngChunk("PLTE", raw("\x00\x00\x00\x1e\x1e\x1e\xff\xff\xff"));
  MapPicture picture = read(png);
  expectNear(picture.brightness, {0, 30, 255});
  EXPECT_TRUE(picture.alpha.empty());
  png.extra += pngChunk("tRNS", raw("\xff\x80"));
  picture = read(png);
  expectNear(picture.brightness, {0, 30, 255});
  expectNear(picture.alpha, {255, 128, 255});
}

TEST(PngTest, ReadsTheTransparentGrey) {
  PngBuilder png = builder(2, 1, 8, 0, raw("\0\x64\x65"));
  png.extra = pngChunk("tRNS", raw("\x00\x64"));
  expectNear(read(png).alpha, {0, 255});
}

TEST(PngTest, LeavesGammaAndOtherRemarksAlone) {
  PngBuilder png = builder(1, 1, 8, 0, raw("\0\x64"));
  png.extra = pngChunk("gAMA", test::bigEndian(22000)) + pngChunk("tEXt", raw("Title\0map"));
  EXPECT_EQ(read(png).brightness, (Values{100}));
}

TEST(PngTest, TakesImageDataInPiecesAndWithFilters) {
  const PngBuilder png = builder(2, 2, 8, 0, raw("\1\x05\x05\2\x01\x01"));
  const std::string data = test::compressed(png.rows);
  const std::string bytes = PngBuilder::signature() + png.header() +
                            pngChunk("IDAT", data.substr(0, 3)) + pngChunk("IDAT", data.substr(3)) +
                            pngChunk("IEND", "");
  EXPECT_EQ(parsePng("a.png", bytes).brightness, (Values{5, 10, 6, 11}));
}

TEST(PngTest, TakesANewLineBehindTheEnd) {
  const PngBuilder png = builder(2, 1, 8, 0, raw("\0\x01\x02"));
  EXPECT_EQ(parsePng("a.png", png.bytes() + "\n").brightness, (Values{1, 2}));
}

// The rows of an interlaced picture of up to a byte a sample, made of those of a plain one.
std::string interlacedRows(const std::vector<std::vector<int>>& samples, int bit_depth) {
  constexpr std::size_t kPasses[7][4] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                         {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
  std::string rows;
  for (const auto& [first_x, first_y, step_x, step_y] : kPasses) {
    for (std::size_t y = first_y; y < samples.size(); y += step_y) {
      if (first_x >= samples[y].size()) continue;
      rows += '\0';
      int bits = 0;
      for (std::size_t x = first_x; x < samples[y].size(); x += step_x) {
        if (bits == 0) rows += '\0';
        rows.back() = static_cast<char>(rows.back() | samples[y][x] << (8 - bit_depth - bits));
        bits = (bits + bit_depth) % 8;
      }
    }
  }
  return rows;
}

TEST(PngTest, ReadsInterlacedPicturesOfEverySizeAndDepth) {
  for (const int bit_depth : {1, 2, 4, 8}) {
    for (std::uint32_t side = 1; side <= 17; ++side) {
      const std::uint32_t height = side % 5 + 1;
      const int most = (1 << bit_depth) - 1;
      std::vector<std::vector<int>> samples(height, std::vector<int>(side));
      Values expected;
      for (std::uint32_t i = 0; i < side * height; ++i) {
        const int sample = static_cast<int>(i * i + 3 * i) % (most + 1);
        samples[i / side][i % side] = sample;
        expected.push_back(static_cast<float>(sample) * 255 / static_cast<float>(most));
      }
      PngBuilder png = builder(side, height, bit_depth, 0, interlacedRows(samples, bit_depth));
      png.interlace = 1;
      SCOPED_TRACE(std::to_string(side) + " pixels of " + std::to_string(bit_depth) + " bits");
      expectNear(read(png).brightness, expected);
    }
  }
}

class PngErrorTest : public test::FileTest {
 protected:
  std::string errorOfPng(const std::string& bytes) const {
    return errorOf([&] { parsePng("a.png", bytes); });
  }
  const PngBuilder good_ = builder(2, 2, 8, 0, raw("\0\x01\x02\0\x03\x04"));
};

TEST_F(PngErrorTest, NamesWhereTheFileIsCutOff) {
  const std::string bytes = good_.bytes();
  for (std::size_t size = 8; size < bytes.size(); ++size) {
    const std::string error = errorOfPng(bytes.substr(0, size));
    const std::string place = "a.png: byte " + std::to_string(size) + ": read the end of the file";
    EXPECT_EQ(error.substr(0, place.size()), place);
  }
  EXPECT_EQ(errorOfPng(bytes.substr(0, 19)),
            "a.png: byte 19: read the end of the file, expected a whole chunk from byte 8 on");
  EXPECT_EQ(errorOfPng(bytes.substr(0, 30)),
            "a.png: byte 30: read the end of the file, expected the 13 bytes of chunk 'IHDR' from "
            "byte 16 on, and its checksum");
  EXPECT_EQ(errorOfPng(bytes.substr(0, 5)), "a.png: byte 0: expected the signature of a PNG file");
}

TEST_F(PngErrorTest, NoticesEveryDamagedByte) {
  const std::string bytes = good_.bytes();
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x40);
    EXPECT_NE(errorOfPng(damaged), "") << "byte " << i;
  }
  std::string damaged = bytes;
  damaged[45] = static_cast<char>(damaged[45] ^ 1);
  EXPECT_EQ(errorOfPng(damaged).substr(0, 78),
            "a.png: byte " + std::to_string(bytes.size() - 16) +
                ": read a checksum that does not fit chunk 'IDAT', expected an un");
}

TEST_F(PngErrorTest, NamesABadHeader) {
  PngBuilder png = good_;
  png.width = 0;
  EXPECT_EQ(errorOfPng(png.bytes()), "a.png: byte 16: read a width of 0, expected 1 to 32768");
  png = good_;
  png.height = 32769;
  EXPECT_EQ(errorOfPng(png.bytes()), "a.png: byte 20: read a height of 32769, expected 1 to 32768");
  png = good_;
  png.bit_depth = 3;
  EXPECT_EQ(errorOfPng(png.bytes()),
            "a.png: byte 24: read colour type 0 of 3 bits, expected a combination that PNG has");
  png = good_;
  png.interlace = 2;
  EXPECT_EQ(errorOfPng(png.bytes()), "a.png: byte 28: read interlace method 2, expected 0 or 1");
  EXPECT_EQ(errorOfPng(PngBuilder::signature() + pngChunk("IEND", "")),
            "a.png: byte 12: read chunk 'IEND', expected 'IHDR'");
  EXPECT_EQ(errorOfPng(PngBuilder::signature() + pngChunk("IHDR", "abc")),
            "a.png: byte 8: read an IHDR chunk of 3 bytes, expected one of 13 bytes");
}

TEST_F(PngErrorTest, NamesChunksThatAreMissingOrStrange) {
  const std::string head = PngBuilder::signature() + good_.header();
  EXPECT_EQ(errorOfPng(head + pngChunk("IEND", "")),
            "a.png: byte 45: read no IDAT chunk, expected image data");
  EXPECT_EQ(errorOfPng(head + pngChunk("ABCD", "")),
            "a.png: byte 37: read chunk 'ABCD', expected one of PNG's own");
  EXPECT_EQ(errorOfPng(good_.bytes() + good_.bytes()),
            "a.png: byte " + std::to_string(good_.bytes().size()) +
                ": read a second PNG picture, expected the end of the file");
  EXPECT_EQ(errorOfPng(builder(1, 1, 8, 3, raw("\0\0")).bytes()),
            "a.png: byte 67: read no PLTE chunk, expected the palette");
}

TEST_F(PngErrorTest, NamesBadPalettesAndTransparency) {
  const auto with = [&](int bit_depth, int colour_type, const std::string& extra) {
    PngBuilder png = builder(1, 1, bit_depth, colour_type, raw("\0\0"));
    png.extra = extra;
    return errorOfPng(png.bytes());
  };
  const std::string palette = pngChunk("PLTE", "abcdef");
  EXPECT_EQ(with(1, 3, palette + pngChunk("tRNS", "a")), "");
  EXPECT_EQ(with(1, 3, pngChunk("PLTE", "abcd")),
            "a.png: byte 33: read a PLTE chunk of 4 bytes, expected one, before image data, of 1 "
            "to 2 colours of 3 bytes");
  EXPECT_NE(with(1, 3, pngChunk("PLTE", "abcdefghi")), "");
  EXPECT_NE(with(1, 3, pngChunk("PLTE", "")), "");
  EXPECT_NE(with(1, 3, palette + palette), "");
  EXPECT_EQ(with(1, 3, palette + pngChunk("tRNS", "abc")),
            "a.png: byte 51: read a tRNS chunk of 3 bytes, expected one, before image data, that "
            "fits colour type 3");
  EXPECT_NE(with(1, 3, pngChunk("tRNS", "a") + palette), "");
  EXPECT_EQ(with(4, 0, pngChunk("tRNS", raw("\x00\x0f"))), "");
  EXPECT_NE(with(4, 0, pngChunk("tRNS", raw("\x00\x10"))), "");
  EXPECT_NE(with(4, 0, pngChunk("tRNS", "abc")), "");
  EXPECT_NE(with(8, 4, pngChunk("tRNS", "ab")), "");
}

TEST_F(PngErrorTest, NamesBadImageData) {
  EXPECT_EQ(errorOfPng(builder(2, 2, 8, 0, raw("\0\x01\x02\0\x03")).bytes()),
            "a.png: byte 33: read image data that ends after 5 bytes when decompressed, expected "
            "6");
  EXPECT_EQ(errorOfPng(builder(2, 2, 8, 0, raw("\0\x01\x02\0\x03\x04\x05")).bytes()),
            "a.png: byte 33: read too much image data, expected 6 bytes when decompressed");
  EXPECT_EQ(errorOfPng(builder(2, 2, 8, 0, raw("\0\x01\x02\5\x03\x04")).bytes()),
            "a.png: byte 33: read filter 5 in the image data, expected 0 to 4");
  PngBuilder interlaced = builder(3, 1, 8, 0, raw("\0\x01\0\x02\7\x03"));
  interlaced.interlace = 1;
  EXPECT_EQ(errorOfPng(interlaced.bytes()),
            "a.png: byte 33: read filter 7 in the image data, expected 0 to 4");
  interlaced.rows = raw("\0\x01\x02\x03");
  EXPECT_EQ(errorOfPng(interlaced.bytes()),
            "a.png: byte 33: read image data that ends after 4 bytes when decompressed, expected "
            "6");
  const std::string head = PngBuilder::signature() + good_.header();
  EXPECT_EQ(errorOfPng(head + pngChunk("IDAT", "no zlib data") + pngChunk("IEND", "")),
            "a.png: byte 33: read image data that cannot be decompressed, expected zlib data");
  const std::string half = test::compressed(good_.rows).substr(0, 5);
  EXPECT_EQ(errorOfPng(head + pngChunk("IDAT", half) + pngChunk("IEND", "")).substr(0, 42),
            "a.png: byte 33: read image data that ends ");
}

}  // namespace
}  // namespace split_mapf
