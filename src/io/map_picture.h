#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace split_mapf {

/// Greatest side of a map's picture, the greatest of a Grid [pixels].
constexpr std::uint32_t kMaxPictureSide = 1U << 15;

/// A picture as far as map_server cares. Row-major from the top.
struct MapPicture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<float> brightness;  ///< mean of a pixel's colour channels, 0 .. 255
  std::vector<float> alpha;       ///< opacity 0 .. 255; empty without an alpha channel
};

/// Whether the bytes begin as a PNM file does.
bool isPnm(const std::string& bytes);

/// Reads a PNM picture: PBM (P1, P4), PGM (P2, P5) or PPM (P3, P6), maxval 1 .. 65535, scaled to
/// 0 .. 255. No sample above maxval, none too few, nothing but white space after the last one.
/// @param path  for messages; @param bytes  the file. @throws InputError: "path:line" for P1 to P3,
/// "path: byte N" for P4 to P6.
MapPicture parsePnm(const std::string& path, const std::string& bytes);

/// Reads a PNG picture of any colour type, 1 to 16 bit, interlaced or not.
/// @param path  for messages; @param bytes  the file. @throws InputError: "path: byte N".
MapPicture parsePng(const std::string& path, const std::string& bytes);

}  // namespace split_mapf
