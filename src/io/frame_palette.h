#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "split_mapf/io/picture.h"

namespace split_mapf {

/// The colours of a film in as few as a byte can tell. Not thread-safe: it remembers answers.
class FramePalette {
 public:
  /// The `most` most frequent colours of the samples, told apart by 5 bits a channel.
  FramePalette(const std::vector<Picture>& samples, std::size_t most);

  const std::vector<Colour>& colours() const { return colours_; }
  /// The index of the nearest one.
  std::uint8_t nearest(Colour colour);

 private:
  std::vector<Colour> colours_;
  std::vector<std::int16_t> nearest_;  ///< a bin; -1: not asked for yet
};

}  // namespace split_mapf
