#include "io/png_image_data.h"

#include <zlib.h>

#include <array>
#include <utility>

namespace split_mapf {
namespace {

// Decompresses image data piece by piece and keeps count of it.
class ImageDataCheck {
 public:
  explicit ImageDataCheck(std::size_t row_bytes) : row_bytes_(row_bytes) { inflateInit(&stream_); }
  ~ImageDataCheck() { inflateEnd(&stream_); }
  ImageDataCheck(const ImageDataCheck&) = delete;
  ImageDataCheck& operator=(const ImageDataCheck&) = delete;

  // What is wrong with the data, or nothing.
  std::string run(std::string data, std::size_t expected) {
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
    const std::size_t row = (bytes_ + row_bytes_ - 1) / row_bytes_;
    for (std::size_t i = row * row_bytes_; i < bytes_ + produced; i += row_bytes_) {
      const int filter = block_[i - bytes_];
      if (filter > 4 && bad_filter_ < 0) bad_filter_ = filter;
    }
    bytes_ += produced;
  }

  z_stream stream_{};
  std::size_t row_bytes_;
  std::size_t bytes_ = 0;
  int bad_filter_ = -1;
  std::array<unsigned char, 1U << 16> block_{};
};

}  // namespace

std::string faultOfImageData(std::string data, std::size_t row_bytes, std::size_t expected) {
  return ImageDataCheck(row_bytes).run(std::move(data), expected);
}

}  // namespace split_mapf
