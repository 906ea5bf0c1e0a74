#include "io/png_image_data.h"

#include <zlib.h>

#include <array>
#include <utility>

namespace split_mapf {
namespace {

// Decompresses image data piece by piece and keeps count of it.
class ImageDataCheck {
 public:
  explicit ImageDataCheck(const std::vector<PngRows>& expected) : expected_(expected) {
    inflateInit(&stream_);
  }
  ~ImageDataCheck() { inflateEnd(&stream_); }
  ImageDataCheck(const ImageDataCheck&) = delete;
  ImageDataCheck& operator=(const ImageDataCheck&) = delete;

  // What is wrong with the data, or nothing.
  std::string run(std::string data) {
    std::size_t expected = 0;
    for (const PngRows& pass : expected_) expected += pass.row_bytes * pass.rows;
    stream_.next_in = reinterpret_cast<Bytef*>(&data[0]);
    stream_.avail_in = static_cast<uInt>(data.size());
    int status = Z_OK;
    while (status == Z_OK && bad_filter_ < 0 && bytes_ <= expected) {
      stream_.next_out = block_.data();
      stream_.avail_out = static_cast<uInt>(block_.size());
      status = inflate(&stream_, Z_NO_FLUSH);
      count(block_.size() - stream_.avail_out);
    }
    if (bytes_ > expected || (status == Z_STREAM_END && stream_.avail_in > 0)) {
      return "read too much image data, expected " + std::to_string(expected) +
             " bytes when decompressed";
    }
    if (bad_filter_ >= 0) {
      return "read filter " + std::to_string(bad_filter_) + " in the image data, expected 0 to 4";
    }
    if (status != Z_OK && status != Z_STREAM_END && status != Z_BUF_ERROR) {
      return "read image data that cannot be decompressed, expected zlib data";
    }
    if (status == Z_STREAM_END && bytes_ == expected) return "";
    return "read image data that ends after " + std::to_string(bytes_) +
           " bytes when decompressed, expected " + std::to_string(expected);
  }

 private:
  // Every row begins with the number of its filter.
  void count(std::size_t produced) {
    for (; pass_ < expected_.size() && row_begin_ < bytes_ + produced; goToNextRow()) {
      const int filter = block_[row_begin_ - bytes_];
      if (filter > 4 && bad_filter_ < 0) bad_filter_ = filter;
    }
    bytes_ += produced;
  }

  void goToNextRow() {
    row_begin_ += expected_[pass_].row_bytes;
    if (++row_ < expected_[pass_].rows) return;
    row_ = 0;
    ++pass_;
  }

  z_stream stream_{};
  const std::vector<PngRows>& expected_;
  std::size_t pass_ = 0;
  std::size_t row_ = 0;
  std::size_t row_begin_ = 0;
  std::size_t bytes_ = 0;
  int bad_filter_ = -1;
  std::array<unsigned char, 1U << 16> block_{};
};

}  // namespace

std::string faultOfImageData(std::string data, const std::vector<PngRows>& expected) {
  return ImageDataCheck(expected).run(std::move(data));
}

}  // namespace split_mapf
