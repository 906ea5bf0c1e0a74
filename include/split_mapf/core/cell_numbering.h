#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "split_mapf/core/deadline.h"

namespace split_mapf {

/// Numbers the marked ones of a row of cells 0, 1, 2, ... and translates both ways, in little more
/// than two bits a cell. Immutable, hence thread-safe. A look-up costs a few nanoseconds more than
/// one in an array.
/// Source: rank and select over a bit vector after Jacobson (FOCS 1989), with one count a word.
class CellNumbering {
 public:
  CellNumbering() = default;
  /// @throws Interrupted. Cost: O(cells).
  explicit CellNumbering(const std::vector<bool>& marked, const Deadline& deadline = {});

  /// How many are marked.
  std::uint32_t size() const { return size_; }
  /// @pre cell < number of cells.
  bool isMarked(std::size_t cell) const { return (words_[cell / 64] >> (cell % 64) & 1U) != 0; }
  /// @pre isMarked(cell), or: the number of the next one that is.
  std::uint32_t numberOf(std::size_t cell) const {
    const std::uint64_t below = words_[cell / 64] & ((std::uint64_t{1} << (cell % 64)) - 1);
    return before_[cell / 64] + static_cast<std::uint32_t>(__builtin_popcountll(below));
  }
  /// The cell of a number. @pre number < size().
  std::size_t cellOf(std::uint32_t number) const;

 private:
  std::vector<std::uint64_t> words_;   // a bit a cell
  std::vector<std::uint32_t> before_;  // marked ones before each word
  std::vector<std::uint32_t> hints_;   // the word of each 64th number
  std::uint32_t size_ = 0;
};

}  // namespace split_mapf
