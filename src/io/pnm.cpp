#include <cctype>

#include "io/file_bytes.h"
#include "io/map_picture.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

bool isBlank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

// Walks over the bytes of one PNM file and knows how to name the place it is at.
class PnmReader {
 public:
  PnmReader(const std::string& path, const std::string& bytes)
      : path_(path),
        bytes_(bytes),
        kind_(isPnm(bytes) ? bytes[1] : '5'),
        plain_(kind_ <= '3'),
        bitmap_(kind_ == '1' || kind_ == '4'),
        channels_(kind_ == '3' || kind_ == '6' ? 3 : 1) {}

  MapPicture read() {
    if (!isPnm(bytes_)) {
      failAtByte(path_, 0, "read " + quote(bytes_.substr(0, 2)) + ", expected 'P1' to 'P6'");
    }
    position_ = 2;
    if (position_ < bytes_.size() && !isBlank(bytes_[position_]) && bytes_[position_] != '#') {
      fail("read " + quote(bytes_.substr(0, 3)) + ", expected 'P" + kind_ + "' and white space");
    }
    MapPicture picture;
    picture.width = readNumber("the width", 1, kMaxPictureSide);
    picture.height = readNumber("the height", 1, kMaxPictureSide);
    maxval_ = bitmap_ ? 1 : readNumber("the maximum value", 1, 65535);
    samples_ = std::size_t{picture.width} * picture.height * channels_;
    if (!plain_) skipToBinarySamples();
    if (plain_) {
      picture.brightness = readPlainSamples();
    } else {
      picture.brightness = bitmap_ ? readBits(picture.width, picture.height) : readBinarySamples();
    }
    if (channels_ == 3) averageColours(picture.brightness);
    return picture;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    if (plain_) failAtLine(path_, line_, message);
    failAtByte(path_, position_, message);
  }

  void skipBlanksAndComments() {
    bool in_comment = false;
    for (; position_ < bytes_.size(); ++position_) {
      const char c = bytes_[position_];
      if (c == '\n') {
        ++line_;
        in_comment = false;
      } else if (c == '#') {
        in_comment = true;
      } else if (!in_comment && !isBlank(c)) {
        return;
      }
    }
  }

  // The word at the present place, up to white space or a comment.
  std::string wordHere() const {
    std::size_t end = position_;
    while (end < bytes_.size() && !isBlank(bytes_[end]) && bytes_[end] != '#') ++end;
    return bytes_.substr(position_, end - position_);
  }

  std::uint32_t readNumber(const std::string& what, std::uint32_t least, std::uint32_t most) {
    skipBlanksAndComments();
    std::uint32_t value = 0;
    std::size_t end = position_;
    while (end < bytes_.size() && std::isdigit(static_cast<unsigned char>(bytes_[end])) != 0 &&
           value <= most) {
      value = value * 10 + static_cast<std::uint32_t>(bytes_[end++] - '0');
    }
    const bool ended = end == bytes_.size() || isBlank(bytes_[end]) || bytes_[end] == '#';
    if (end == position_ || !ended || value < least || value > most) {
      const std::string read =
          position_ == bytes_.size() ? "the end of the file" : quote(wordHere());
      fail("read " + read + ", expected " + what + ", " + std::to_string(least) + " to " +
           std::to_string(most));
    }
    position_ = end;
    return value;
  }

  float scaled(std::uint32_t value) const {
    return static_cast<float>(value * 255.0 / static_cast<double>(maxval_));
  }

  std::string countOf(std::size_t done) const {
    return std::to_string(done) + " of " + std::to_string(samples_);
  }

  std::vector<float> readPlainSamples() {
    std::vector<float> values;
    for (std::size_t i = 0; i < samples_; ++i) {
      values.push_back(bitmap_ ? readDigit(i)
                               : scaled(readNumber("sample " + countOf(i + 1), 0, maxval_)));
    }
    skipBlanksAndComments();
    if (position_ < bytes_.size()) {
      fail("read " + quote(wordHere()) + ", expected the end of the file after " +
           std::to_string(samples_) + " samples");
    }
    return values;
  }

  // A pixel of a plain bitmap: 1 is black, and no blank need part it from the next.
  float readDigit(std::size_t i) {
    skipBlanksAndComments();
    const char digit = position_ < bytes_.size() ? bytes_[position_] : '\0';
    if (digit != '0' && digit != '1') {
      const std::string read =
          position_ == bytes_.size() ? "the end of the file" : quote(std::string(1, digit));
      fail("read " + read + ", expected sample " + countOf(i + 1) + ", 0 or 1");
    }
    ++position_;
    return digit == '1' ? 0 : 255;
  }

  // The same in eight pixels a byte; every row begins with a byte of its own.
  std::vector<float> readBits(std::uint32_t width, std::uint32_t height) {
    const std::size_t row_bytes = (std::size_t{width} + 7) / 8;
    requireLength(row_bytes * height);
    std::vector<float> values;
    values.reserve(samples_);
    for (std::size_t y = 0; y < height; ++y) {
      for (std::size_t x = 0; x < width; ++x) {
        const auto byte = static_cast<unsigned char>(bytes_[position_ + y * row_bytes + x / 8]);
        values.push_back((byte >> (7 - x % 8) & 1U) != 0 ? 0 : 255);
      }
    }
    return values;
  }

  static void averageColours(std::vector<float>& values) {
    const std::size_t pixels = values.size() / 3;
    for (std::size_t i = 0; i < pixels; ++i) {
      values[i] = (values[3 * i] + values[3 * i + 1] + values[3 * i + 2]) / 3;
    }
    values.resize(pixels);
  }

  void skipToBinarySamples() {
    if (position_ == bytes_.size() || !isBlank(bytes_[position_])) {
      fail("read " +
           (position_ == bytes_.size() ? "the end of the file"
                                       : quote(bytes_.substr(position_, 1))) +
           ", expected one white space and the samples");
    }
    ++position_;
  }

  std::vector<float> readBinarySamples() {
    const std::size_t bytes_a_sample = maxval_ > 255 ? 2 : 1;
    requireLength(samples_ * bytes_a_sample);
    std::vector<float> values(samples_);
    for (float& value : values) {
      std::uint32_t sample = static_cast<unsigned char>(bytes_[position_]);
      if (bytes_a_sample == 2) {
        sample = sample << 8U | static_cast<unsigned char>(bytes_[position_ + 1]);
      }
      if (sample > maxval_) {
        fail("read sample " + std::to_string(sample) + ", expected at most the maximum value " +
             std::to_string(maxval_));
      }
      value = scaled(sample);
      position_ += bytes_a_sample;
    }
    return values;
  }

  // White space may follow the samples, as text editors and copies leave it; SDL_image and netpbm
  // pass over whatever comes. Other bytes would mean that the size in the header is not the
  // picture's, and so would a CR LF before the samples, of which CR alone is the header's.
  void requireLength(std::size_t needed) {
    const std::size_t begin = position_;
    const std::size_t left = bytes_.size() - begin;
    if (left < needed) {
      position_ = bytes_.size();
      fail("read the end of the file after " + std::to_string(left) +
           " bytes of samples, expected " + std::to_string(needed));
    }
    if (left == needed) return;
    if (bytes_[begin - 1] == '\r' && bytes_[begin] == '\n') {
      fail("read CR LF and " + std::to_string(left - 1) + " bytes, expected one white space and " +
           std::to_string(needed) + " bytes of samples");
    }
    position_ = begin + needed;
    while (position_ < bytes_.size() && isBlank(bytes_[position_])) ++position_;
    if (position_ < bytes_.size()) {
      const std::size_t extra = left - needed;
      fail("read " + std::to_string(extra) + " more byte" + (extra == 1 ? "" : "s") +
           ", expected the end of the file after " + std::to_string(needed) + " bytes of samples");
    }
    position_ = begin;
  }

  const std::string& path_;
  const std::string& bytes_;
  const char kind_;
  const bool plain_;
  const bool bitmap_;
  const std::size_t channels_;
  std::size_t position_ = 0;
  std::size_t line_ = 1;
  std::uint32_t maxval_ = 0;
  std::size_t samples_ = 0;
};

}  // namespace

bool isPnm(const std::string& bytes) {
  return bytes.size() >= 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6';
}

MapPicture parsePnm(const std::string& path, const std::string& bytes) {
  return PnmReader(path, bytes).read();
}

}  // namespace split_mapf
