#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "split_mapf/io/picture.h"

namespace split_mapf {

/// Writes pictures as an animated GIF that is repeated for ever. Each frame stores what differs
/// from the one before. The 255 colours are those that are most frequent in samples of the film.
/// Not thread-safe. Where the library was built without giflib the constructor throws InputError.
class GifWriter {
 public:
  /// @param samples  some of the pictures to come, all of one size. @param delay_cs  how long a
  /// frame is shown [1/100 s], at least 2 (viewers show less as if it was 10).
  /// @throws InputError when there is no sample, a side is above 65535 pixels, or the delay is out
  /// of range.
  GifWriter(const std::vector<Picture>& samples, std::uint32_t delay_cs);
  ~GifWriter();
  GifWriter(const GifWriter&) = delete;
  GifWriter& operator=(const GifWriter&) = delete;

  /// @throws InputError when it is of another size than the samples. Cost: O(pixels).
  void add(const Picture& picture);
  /// Writes the file, once, behind the last add(). @throws InputError naming the file and the
  /// system's reason.
  void write(const std::string& path);

 private:
  class Stream;
  std::unique_ptr<Stream> stream_;
};

}  // namespace split_mapf
