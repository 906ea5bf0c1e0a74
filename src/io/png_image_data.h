#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace split_mapf {

/// Rows of one length that follow each other in a PNG's image data: all of them, or those of one
/// pass of an interlaced picture.
struct PngRows {
  std::size_t row_bytes = 0;  ///< bytes of a row with its filter in front
  std::size_t rows = 0;
};

/// Decompresses the image data of a PNG file to check it; the pixels themselves are left to libpng.
/// Keeps a block of 64 KiB, never the whole image.
/// @param data      all IDAT chunks in one.
/// @param expected  the rows that the image consists of, none of them empty.
/// @return what is wrong, as "read X, expected Y"; empty when nothing is. Cost: O(image).
std::string faultOfImageData(std::string data, const std::vector<PngRows>& expected);

}  // namespace split_mapf
