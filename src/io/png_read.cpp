#include <png.h>

#include <csetjmp>
#include <cstring>
#include <string>
#include <vector>

#include "io/file_bytes.h"
#include "io/map_picture.h"
#include "io/png_structure.h"

namespace split_mapf {
namespace {

// 16 bits a channel hold every PNG exactly.
constexpr std::size_t kChannels = 4;
constexpr float kToByte = 255.0F / 65535.0F;

// What libpng reads from, and where it says what it does not like.
struct Source {
  const std::string& bytes;
  std::size_t position = 0;
  std::string complaint;
};

void giveBytes(png_structp png, png_bytep out, std::size_t size) {
  auto& source = *static_cast<Source*>(png_get_io_ptr(png));
  if (size > source.bytes.size() - source.position) png_error(png, "the file ends too early");
  std::memcpy(out, source.bytes.data() + source.position, size);
  source.position += size;
}

[[noreturn]] void keepComplaint(png_structp png, png_const_charp message) {
  static_cast<Source*>(png_get_error_ptr(png))->complaint = message;
  png_longjmp(png, 1);
}

void ignoreWarning(png_structp /*png*/, png_const_charp /*message*/) {}

// Has libpng turn whatever the file holds into red, green, blue and alpha of 16 bits in the
// machine's order. @return the number of passes over the rows.
int askForAllChannels(png_structp png) {
  const std::uint16_t probe = 1;
  const bool little_endian = *reinterpret_cast<const unsigned char*>(&probe) == 1;
  png_set_expand_16(png);
  png_set_gray_to_rgb(png);
  png_set_add_alpha(png, 0xffff, PNG_FILLER_AFTER);
  if (little_endian) png_set_swap(png);
  return png_set_interlace_handling(png);
}

// The part of reading that libpng may leave by longjmp: it has no destructors to run.
bool readRows(png_structp png, png_infop info, std::uint32_t height,
              const std::vector<png_bytep>& rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_read_info(png, info);
  const int passes = askForAllChannels(png);
  png_read_update_info(png, info);
  if (png_get_rowbytes(png, info) != png_get_image_width(png, info) * kChannels * 2) {
    png_error(png, "unexpected size of a row");
  }
  for (int pass = 0; pass < passes; ++pass) {
    for (std::uint32_t y = 0; y < height; ++y) png_read_row(png, rows[y], nullptr);
  }
  return true;
}

// All pixels, four channels each.
std::vector<std::uint16_t> decode(const std::string& path, const PngStructure& structure) {
  Source source{structure.essential_bytes, 0, "it does not start"};
  const std::size_t row_values = structure.width * kChannels;
  std::vector<std::uint16_t> values(row_values * structure.height);
  std::vector<png_bytep> rows(structure.height);
  for (std::size_t y = 0; y < rows.size(); ++y) {
    rows[y] = reinterpret_cast<png_bytep>(values.data() + y * row_values);
  }
  png_structp png =
      png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, keepComplaint, ignoreWarning);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  bool good = false;
  if (info != nullptr) {
    png_set_read_fn(png, &source, giveBytes);
    good = readRows(png, info, structure.height, rows);
  }
  png_destroy_read_struct(&png, &info, nullptr);
  if (!good) failAtByte(path, 0, "the PNG reader refuses this file: " + source.complaint);
  return values;
}

}  // namespace

MapPicture parsePng(const std::string& path, const std::string& bytes) {
  const PngStructure structure = checkPng(path, bytes);
  const std::vector<std::uint16_t> values = decode(path, structure);
  MapPicture picture;
  picture.width = structure.width;
  picture.height = structure.height;
  const std::size_t pixels = std::size_t{picture.width} * picture.height;
  picture.brightness.reserve(pixels);
  if (structure.has_alpha) picture.alpha.reserve(pixels);
  for (std::size_t i = 0; i < values.size(); i += kChannels) {
    const float sum = static_cast<float>(values[i]) + static_cast<float>(values[i + 1]) +
                      static_cast<float>(values[i + 2]);
    picture.brightness.push_back(sum * kToByte / 3.0F);
    if (structure.has_alpha) picture.alpha.push_back(static_cast<float>(values[i + 3]) * kToByte);
  }
  return picture;
}

}  // namespace split_mapf
