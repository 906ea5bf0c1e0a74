#include "io/png_structure.h"

#include <zlib.h>

#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "io/file_bytes.h"
#include "io/map_picture.h"
#include "io/png_image_data.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
constexpr int kPalette = 3;

std::uint32_t bigEndianAt(const std::string& bytes, std::size_t i) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    value = value << 8U | static_cast<unsigned char>(bytes[i + k]);
  }
  return value;
}

// Number of channels of a colour type; 0 for a combination that PNG does not have.
std::size_t channelsOf(int colour_type, int bit_depth) {
  static const std::map<int, std::pair<std::size_t, std::set<int>>> kinds = {
      {0, {1, {1, 2, 4, 8, 16}}},
      {2, {3, {8, 16}}},
      {kPalette, {1, {1, 2, 4, 8}}},
      {4, {2, {8, 16}}},
      {6, {4, {8, 16}}}};
  const auto kind = kinds.find(colour_type);
  return kind == kinds.end() || kind->second.second.count(bit_depth) == 0 ? 0 : kind->second.first;
}

// Walks over the chunks of one PNG file.
class PngChecker {
 public:
  PngChecker(const std::string& path, const std::string& bytes) : path_(path), bytes_(bytes) {}

  PngStructure check() {
    if (!isPng(bytes_)) failAtByte(path_, 0, "expected the signature of a PNG file");
    found_.essential_bytes = kSignature;
    std::size_t position = kSignature.size();
    std::string type;
    while (type != "IEND") {
      type = takeChunk(position, type.empty());
      position = next_;
    }
    if (isPng(bytes_.substr(position, kSignature.size()))) {
      failAtByte(path_, position, "read a second PNG picture, expected the end of the file");
    }
    requireImageData(position);
    return std::move(found_);
  }

 private:
  std::string takeChunk(std::size_t position, bool first) {
    const std::size_t left = bytes_.size() - position;
    if (left < 12) {
      failAtByte(path_, bytes_.size(),
                 "read the end of the file, expected a whole chunk from byte " +
                     std::to_string(position) + " on");
    }
    const std::uint32_t length = bigEndianAt(bytes_, position);
    std::string type = bytes_.substr(position + 4, 4);
    if (first && type != "IHDR") {
      failAtByte(path_, position + 4, "read chunk " + quote(type) + ", expected 'IHDR'");
    }
    if (length > left - 12) {
      failAtByte(path_, bytes_.size(),
                 "read the end of the file, expected the " + std::to_string(length) +
                     " bytes of chunk " + quote(type) + " from byte " +
                     std::to_string(position + 8) + " on, and its checksum");
    }
    requireChecksum(position, length, type);
    next_ = position + 12 + length;
    keep(position, length, type);
    return type;
  }

  void requireChecksum(std::size_t position, std::uint32_t length, const std::string& type) const {
    const auto* data = reinterpret_cast<const Bytef*>(bytes_.data()) + position + 4;
    const auto actual = static_cast<std::uint32_t>(crc32(0, data, length + 4));
    if (actual == bigEndianAt(bytes_, position + 8 + length)) return;
    failAtByte(
        path_, position + 8 + length,
        "read a checksum that does not fit chunk " + quote(type) + ", expected an undamaged file");
  }

  void keep(std::size_t position, std::uint32_t length, const std::string& type) {
    const bool ancillary = (static_cast<unsigned char>(type[0]) & 0x20U) != 0;
    if (type == "IHDR") {
      readHeader(position, length);
    } else if (type == "PLTE") {
      if (found_.colour_type != kPalette) return;  // only a suggestion then
      requirePalette(position, length);
    } else if (type == "tRNS") {
      requireTransparency(position, length);
    } else if (type == "IDAT") {
      if (image_data_.empty()) first_data_ = position;
      image_data_.append(bytes_, position + 8, length);
    } else if (ancillary) {
      return;
    } else if (type != "IEND") {
      failAtByte(path_, position + 4, "read chunk " + quote(type) + ", expected one of PNG's own");
    }
    found_.essential_bytes.append(bytes_, position, 12 + std::size_t{length});
  }

  void requirePalette(std::size_t position, std::uint32_t length) {
    const std::size_t most = std::size_t{1} << static_cast<unsigned>(found_.bit_depth);
    const bool in_place = palette_entries_ == 0 && !found_.has_alpha && image_data_.empty();
    if (!in_place || length % 3 != 0 || length == 0 || length / 3 > most) {
      failAtByte(path_, position,
                 "read a PLTE chunk of " + std::to_string(length) +
                     " bytes, expected one, before image data, of 1 to " + std::to_string(most) +
                     " colours of 3 bytes");
    }
    palette_entries_ = length / 3;
  }

  void requireTransparency(std::size_t position, std::uint32_t length) {
    const bool in_place = !found_.has_alpha && image_data_.empty();
    bool fits = found_.colour_type == kPalette && length > 0 && length <= palette_entries_;
    if (found_.colour_type == 0 || found_.colour_type == 2) {
      fits = length == 2 * channels_;
      for (std::size_t i = position + 8; fits && i < position + 8 + length; i += 2) {
        const std::uint32_t level = bigEndianAt(bytes_, i) >> 16U;
        fits = level >> static_cast<unsigned>(found_.bit_depth) == 0;
      }
    }
    if (!in_place || !fits) {
      failAtByte(path_, position,
                 "read a tRNS chunk of " + std::to_string(length) +
                     " bytes, expected one, before image data, that fits colour "
                     "type " +
                     std::to_string(found_.colour_type));
    }
    found_.has_alpha = true;
  }

  void readHeader(std::size_t position, std::uint32_t length) {
    const std::size_t data = position + 8;
    if (length != 13 || found_.width != 0) {
      failAtByte(path_, position,
                 "read an IHDR chunk of " + counted(length, "byte") + ", expected one of 13 bytes");
    }
    found_.width = sideAt(data, "width");
    found_.height = sideAt(data + 4, "height");
    found_.bit_depth = static_cast<unsigned char>(bytes_[data + 8]);
    found_.colour_type = static_cast<unsigned char>(bytes_[data + 9]);
    channels_ = channelsOf(found_.colour_type, found_.bit_depth);
    if (channels_ == 0) {
      failAtByte(path_, data + 8,
                 "read colour type " + std::to_string(found_.colour_type) + " of " +
                     counted(found_.bit_depth, "bit") + ", expected a combination that PNG has");
    }
    if (bytes_[data + 10] != 0 || bytes_[data + 11] != 0) {
      failAtByte(path_, data + 10, "read an unknown compression or filter, expected 0");
    }
    const unsigned interlace = static_cast<unsigned char>(bytes_[data + 12]);
    if (interlace > 1) {
      failAtByte(path_, data + 12,
                 "read interlace method " + std::to_string(interlace) + ", expected 0 or 1");
    }
    found_.interlaced = interlace == 1;
    found_.has_alpha = found_.colour_type == 4 || found_.colour_type == 6;
  }

  std::uint32_t sideAt(std::size_t position, const std::string& name) const {
    const std::uint32_t side = bigEndianAt(bytes_, position);
    if (side == 0 || side > kMaxPictureSide) {
      failAtByte(path_, position,
                 "read a " + name + " of " + std::to_string(side) + ", expected 1 to " +
                     std::to_string(kMaxPictureSide));
    }
    return side;
  }

  void requireImageData(std::size_t end) {
    if (found_.colour_type == kPalette && palette_entries_ == 0) {
      failAtByte(path_, end, "read no PLTE chunk, expected the palette");
    }
    if (image_data_.empty()) failAtByte(path_, end, "read no IDAT chunk, expected image data");
    const std::string fault = faultOfImageData(std::move(image_data_), expectedRows());
    if (!fault.empty()) failAtByte(path_, first_data_, fault);
  }

  PngRows rowsOf(std::size_t width, std::size_t height) const {
    const std::size_t bits = channels_ * static_cast<std::size_t>(found_.bit_depth) * width;
    return {1 + (bits + 7) / 8, height};
  }

  // An interlaced picture comes as seven coarser ones, of which small pictures lack some.
  std::vector<PngRows> expectedRows() const {
    if (!found_.interlaced) return {rowsOf(found_.width, found_.height)};
    struct Pass {
      std::size_t first_column, first_row, columns_apart, rows_apart;
    };
    constexpr Pass kPasses[] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
    const auto count = [](std::size_t side, std::size_t first, std::size_t apart) {
      return (side + apart - 1 - first) / apart;
    };
    std::vector<PngRows> rows;
    for (const Pass& pass : kPasses) {
      const std::size_t columns = count(found_.width, pass.first_column, pass.columns_apart);
      const std::size_t lines = count(found_.height, pass.first_row, pass.rows_apart);
      if (columns > 0 && lines > 0) rows.push_back(rowsOf(columns, lines));
    }
    return rows;
  }

  const std::string& path_;
  const std::string& bytes_;
  PngStructure found_;
  std::size_t next_ = 0;
  std::size_t channels_ = 0;
  std::size_t first_data_ = 0;
  std::size_t palette_entries_ = 0;
  std::string image_data_;
};

}  // namespace

bool isPng(const std::string& bytes) {
  return bytes.compare(0, kSignature.size(), kSignature) == 0;
}

PngStructure checkPng(const std::string& path, const std::string& bytes) {
  return PngChecker(path, bytes).check();
}

}  // namespace split_mapf
