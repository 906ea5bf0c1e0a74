#pragma once

#include <algorithm>
#include <cstddef>

namespace split_mapf {

/// How many robots are searched for side by side before their paths are taken one after another:
/// more while hardly any has to be searched for again because it met another of its batch, half as
/// many once more than a fifth do. Depends on what happened only, not on threads or the clock.
class BatchSize {
 public:
  std::size_t get() const { return size_; }
  void adapt(std::size_t searched, std::size_t postponed) {
    size_ = kPostponedOneIn * postponed > searched ? std::max<std::size_t>(1, size_ / 2)
                                                   : std::min(size_ + 1, kLargest);
  }

 private:
  static constexpr std::size_t kLargest = 32;
  static constexpr std::size_t kPostponedOneIn = 5;

  std::size_t size_ = 1;
};

}  // namespace split_mapf
