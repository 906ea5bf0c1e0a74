#include "split_mapf/io/gif.h"

#include <gtest/gtest.h>

#ifdef SPLIT_MAPF_HAS_GIF

#include <gif_lib.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "io/temporary_files.h"
#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

class GifWriterTest : public test::FileTest {};

Picture plain(std::uint32_t width, std::uint32_t height, Colour colour) {
  return {width, height, std::vector<Colour>(std::size_t{width} * height, colour)};
}

/// What a viewer shows for each frame of the file, by giflib's own reader.
std::vector<Picture> shownFrames(const std::string& path, std::vector<int>& delays_cs) {
  int error = 0;
  GifFileType* gif = DGifOpenFileName(path.c_str(), &error);
  EXPECT_NE(gif, nullptr);
  EXPECT_EQ(DGifSlurp(gif), GIF_OK);
  std::vector<Picture> frames;
  Picture shown =
      plain(static_cast<std::uint32_t>(gif->SWidth), static_cast<std::uint32_t>(gif->SHeight), {});
  for (int i = 0; i < gif->ImageCount; ++i) {
    const SavedImage& image = gif->SavedImages[i];
    GraphicsControlBlock control{};
    EXPECT_EQ(DGifSavedExtensionToGCB(gif, i, &control), GIF_OK);
    delays_cs.push_back(control.DelayTime);
    const GifImageDesc& where = image.ImageDesc;
    for (int y = 0; y < where.Height; ++y) {
      for (int x = 0; x < where.Width; ++x) {
        const int index = image.RasterBits[y * where.Width + x];
        if (index == control.TransparentColor) continue;
        const GifColorType c = gif->SColorMap->Colors[index];
        shown.pixels[static_cast<std::size_t>(where.Top + y) * shown.width_px +
                     static_cast<std::size_t>(where.Left + x)] = {c.Red, c.Green, c.Blue};
      }
    }
    frames.push_back(shown);
  }
  DGifCloseFile(gif, &error);
  return frames;
}

TEST_F(GifWriterTest, ShowsEachPictureInItsTurn) {
  const Colour paper{250, 250, 247};
  std::vector<Picture> pictures(4, plain(7, 5, paper));
  for (std::size_t i = 0; i < 3; ++i) pictures[i].pixels[7 * (i + 1) + i] = {200, 30, 40};
  pictures[3] = pictures[2];  // nothing changes
  GifWriter gif(pictures, 5);
  for (const Picture& picture : pictures) gif.add(picture);
  const std::string path = pathOf("film.gif");
  gif.write(path);
  std::vector<int> delays_cs;
  const std::vector<Picture> shown = shownFrames(path, delays_cs);
  ASSERT_EQ(shown.size(), pictures.size());
  EXPECT_EQ(delays_cs, std::vector<int>(pictures.size(), 5));
  for (std::size_t i = 0; i < shown.size(); ++i) EXPECT_EQ(shown[i].pixels, pictures[i].pixels);
}

TEST_F(GifWriterTest, TakesTheNearestOfMoreColoursThanAFileCanHold) {
  Picture picture = plain(64, 64, {});
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    picture.pixels[i] = {static_cast<std::uint8_t>(4 * (i % 64)),
                         static_cast<std::uint8_t>(4 * (i / 64)), 128};
  }
  GifWriter gif({picture}, 10);
  gif.add(picture);
  gif.write(pathOf("many.gif"));
  std::vector<int> delays_cs;
  const std::vector<Picture> shown = shownFrames(pathOf("many.gif"), delays_cs);
  ASSERT_EQ(shown.size(), 1U);
  int farthest = 0;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    farthest = std::max({farthest, std::abs(shown[0].pixels[i].red - picture.pixels[i].red),
                         std::abs(shown[0].pixels[i].green - picture.pixels[i].green)});
  }
  EXPECT_GT(farthest, 0);
  EXPECT_LT(farthest, 200);
}

TEST_F(GifWriterTest, RefusesWhatCannotBeAFilm) {
  EXPECT_THROW(GifWriter({}, 5), InputError);
  EXPECT_THROW(GifWriter({plain(2, 2, {})}, 1), InputError);
  EXPECT_THROW(GifWriter({plain(70000, 1, {})}, 5), InputError);
  GifWriter gif({plain(2, 2, {})}, 5);
  EXPECT_THROW(gif.add(plain(3, 2, {})), InputError);
  gif.add(plain(2, 2, {}));
  EXPECT_THROW(gif.write("/no/such/folder/film.gif"), InputError);
  EXPECT_THROW(gif.add(plain(2, 2, {})), InputError);  // it is written
}

}  // namespace
}  // namespace split_mapf

#endif
