#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace split_mapf {

/// What a PNG file says of itself, once its structure has proved sound.
struct PngStructure {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  int bit_depth = 0;
  int colour_type = 0;  ///< as in the PNG specification: 0, 2, 3, 4 or 6
  bool interlaced = false;
  bool has_alpha = false;  ///< by an alpha channel or by a tRNS chunk
  /// The file with nothing but the chunks that decide the pixels' values.
  std::string essential_bytes;
};

/// Whether the bytes begin as a PNG file does.
bool isPng(const std::string& bytes);

/// Checks a PNG file before libpng sees it: chunks, checksums, header, and the length of the
/// decompressed image. libpng reports through longjmp and on standard error, and names no place.
/// What stands behind its end is left alone, as all readers do, unless it is a second picture.
/// @throws InputError "path: byte N: ..." for what is damaged or cut off. Cost: O(pixels).
PngStructure checkPng(const std::string& path, const std::string& bytes);

}  // namespace split_mapf
