#include <ios>
#include <sstream>

#include "io/file_bytes.h"
#include "io/map_picture.h"
#include "io/png_gil.h"
#include "io/png_structure.h"

namespace split_mapf {
namespace {

// 16 bits a channel hold every PNG exactly.
using Image = boost::gil::rgba16_image_t;
constexpr float kToByte = 255.0F / 65535.0F;

Image decode(const std::string& path, const std::string& bytes) {
  std::istringstream in(bytes, std::ios::binary);
  Image image;
  try {
    boost::gil::read_and_convert_image(in, image, boost::gil::png_tag());
  } catch (const std::ios_base::failure& error) {
    failAtByte(path, 0, std::string("the PNG reader refuses this file: ") + error.what());
  }
  return image;
}

}  // namespace

MapPicture parsePng(const std::string& path, const std::string& bytes) {
  const PngStructure structure = checkPng(path, bytes);
  const Image image = decode(path, structure.essential_bytes);
  MapPicture picture;
  picture.width = structure.width;
  picture.height = structure.height;
  const std::size_t pixels = std::size_t{picture.width} * picture.height;
  picture.brightness.reserve(pixels);
  if (structure.has_alpha) picture.alpha.reserve(pixels);
  for (const auto& pixel : boost::gil::const_view(image)) {
    const float sum =
        static_cast<float>(pixel[0]) + static_cast<float>(pixel[1]) + static_cast<float>(pixel[2]);
    picture.brightness.push_back(sum * kToByte / 3.0F);
    if (structure.has_alpha) picture.alpha.push_back(static_cast<float>(pixel[3]) * kToByte);
  }
  return picture;
}

}  // namespace split_mapf
