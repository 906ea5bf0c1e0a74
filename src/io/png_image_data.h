#pragma once

#include <cstddef>
#include <string>

namespace split_mapf {

/// Decompresses the image data of a PNG file to check it; the pixels themselves are left to GIL.
/// Keeps a block of 64 KiB, never the whole image.
/// @param data       all IDAT chunks in one.
/// @param row_bytes  bytes of a row with its filter in front.
/// @param expected   bytes that the image takes when decompressed.
/// @return what is wrong, as "read X, expected Y"; empty when nothing is. Cost: O(expected).
std::string faultOfImageData(std::string data, std::size_t row_bytes, std::size_t expected);

}  // namespace split_mapf
