#include "split_mapf/core/cell_numbering.h"

#include <algorithm>

namespace split_mapf {
namespace {

constexpr std::size_t kWordBits = 64;
constexpr std::uint32_t kNumbersAHint = 64;

/// The place of the n-th set bit, from 0. @pre there are more than n.
unsigned placeOfSetBit(std::uint64_t word, unsigned n) {
  unsigned place = 0;
  for (unsigned width = 32; width > 0; width /= 2) {
    const std::uint64_t low = word & ((std::uint64_t{1} << width) - 1);
    const auto count = static_cast<unsigned>(__builtin_popcountll(low));
    if (n < count) {
      word = low;
    } else {
      n -= count;
      place += width;
      word >>= width;
    }
  }
  return place;
}

}  // namespace

CellNumbering::CellNumbering(const std::vector<bool>& marked, const Deadline& deadline)
    : words_((marked.size() + kWordBits - 1) / kWordBits, 0), before_(words_.size()) {
  SparsePoll poll(deadline);
  for (std::size_t word = 0; word < words_.size(); ++word) {
    poll();
    const std::size_t first = word * kWordBits;
    const std::size_t count = std::min(kWordBits, marked.size() - first);
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < count; ++i) {
      bits |= std::uint64_t{marked[first + i] ? 1U : 0U} << i;
    }
    words_[word] = bits;
    before_[word] = size_;
    size_ += static_cast<std::uint32_t>(__builtin_popcountll(bits));
    while (hints_.size() * kNumbersAHint < size_) {
      hints_.push_back(static_cast<std::uint32_t>(word));
    }
  }
}

std::size_t CellNumbering::cellOf(std::uint32_t number) const {
  std::size_t word = hints_[number / kNumbersAHint];
  const std::size_t next = number / kNumbersAHint + 1;
  const std::size_t last = next < hints_.size() ? hints_[next] : words_.size() - 1;
  if (last - word > 8) {
    // Few are marked around here: the last word that begins at or below the number.
    const auto begin = before_.begin() + static_cast<std::ptrdiff_t>(word);
    const auto end = before_.begin() + static_cast<std::ptrdiff_t>(last + 1);
    word = static_cast<std::size_t>(std::upper_bound(begin, end, number) - before_.begin()) - 1;
  } else {
    while (word < last && before_[word + 1] <= number) ++word;
  }
  return word * kWordBits + placeOfSetBit(words_[word], number - before_[word]);
}

}  // namespace split_mapf
