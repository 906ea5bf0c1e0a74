#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>

namespace split_mapf::test {

inline std::string bigEndian(std::uint32_t value) {
  return {static_cast<char>(value >> 24U), static_cast<char>(value >> 16U),
          static_cast<char>(value >> 8U), static_cast<char>(value)};
}

/// One PNG chunk with its length and checksum.
inline std::string pngChunk(const std::string& type, const std::string& data) {
  const std::string checked = type + data;
  const auto checksum =
      crc32(0, reinterpret_cast<const Bytef*>(checked.data()), static_cast<uInt>(checked.size()));
  return bigEndian(static_cast<std::uint32_t>(data.size())) + checked +
         bigEndian(static_cast<std::uint32_t>(checksum));
}

inline std::string compressed(const std::string& data) {
  uLongf size = compressBound(static_cast<uLong>(data.size()));
  std::string out(size, '\0');
  compress(reinterpret_cast<Bytef*>(&out[0]), &size, reinterpret_cast<const Bytef*>(data.data()),
           static_cast<uLong>(data.size()));
  out.resize(size);
  return out;
}

/// A PNG file put together by hand, so that a test can make any kind and any damage.
struct PngBuilder {
  std::uint32_t width = 1;
  std::uint32_t height = 1;
  char bit_depth = 8;
  char colour_type = 0;
  char interlace = 0;
  std::string extra;  ///< chunks between IHDR and IDAT
  std::string rows;   ///< filter and samples of every row

  static std::string signature() { return {"\x89PNG\r\n\x1a\n", 8}; }
  std::string header() const {
    return pngChunk("IHDR", bigEndian(width) + bigEndian(height) + bit_depth + colour_type +
                                std::string(2, '\0') + interlace);
  }
  std::string bytes() const {
    return signature() + header() + extra + pngChunk("IDAT", compressed(rows)) +
           pngChunk("IEND", "");
  }
};

}  // namespace split_mapf::test
