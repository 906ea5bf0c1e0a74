#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "search/heading_graph.h"

namespace split_mapf {

/// For each heading what it costs a robot to stand at a place, turned to it: four numbers in one
/// word, for searches that look at all at once. As it turns in place, headings side by side differ
/// by kTurn at the most, opposite ones by twice as much. None may be more than kMost.
class HeadingCosts {
 public:
  /// Of a quarter turn.
  static constexpr std::uint32_t kTurn = 64;
  // Four quarter turns and a move may come on top: each number has 15 bits.
  static constexpr std::uint32_t kMost = 0x7e00;

  HeadingCosts() = default;
  /// Of a robot that comes with this heading; kNoHeading: with any.
  HeadingCosts(Heading heading, std::uint32_t cost)
      : four_(cost * kOnes + kTurn * kTurned[heading]) {}

  std::uint32_t operator[](Heading heading) const {
    return static_cast<std::uint32_t>(four_ >> (16U * heading)) & 0xffffU;
  }
  std::uint32_t least() const { return std::min({(*this)[0], (*this)[1], (*this)[2], (*this)[3]}); }
  /// Of two ways to come there.
  HeadingCosts orLess(HeadingCosts other) const {
    const std::uint64_t high = notBelow(other);
    const std::uint64_t taken = high - (high >> 15U);
    return HeadingCosts(four_ ^ ((four_ ^ other.four_) & taken));
  }

  /// A set of headings: bit 16 h + 15 for heading h.
  using Headings = std::uint64_t;
  static constexpr Headings kAll = 0x8000800080008000ULL;
  static Headings only(Heading heading, bool there = true) {
    return Headings{there ? 1U : 0U} << (16U * heading + 15U);
  }
  /// @pre there is one.
  static Heading firstOf(Headings headings) {
    return static_cast<Heading>(__builtin_ctzll(headings) / 16);
  }
  /// Those that cost as much as for `other` or more.
  Headings notBelow(HeadingCosts other) const { return ((four_ | kAll) - other.four_) & kAll; }
  /// Those that cost no more than `most`. @pre most <= kMost.
  Headings within(std::uint32_t most) const { return HeadingCosts(most * kOnes).notBelow(*this); }
  /// Those that do with as many turns more as `left` says, two at the most.
  Headings within(std::uint32_t most, const std::array<std::uint8_t, 4>& left) const {
    const std::uint64_t turns = left[0] | std::uint64_t{left[1]} << 16U |
                                std::uint64_t{left[2]} << 32U | std::uint64_t{left[3]} << 48U;
    return HeadingCosts(four_ + kTurn * turns).within(most);
  }

 private:
  static constexpr std::uint64_t kOnes = 0x0001000100010001ULL;
  // Quarter turns to each heading, by the one with which it comes.
  static constexpr std::array<std::uint64_t, 5> kTurned = {
      0x0001000200010000ULL, 0x0002000100000001ULL, 0x0001000000010002ULL, 0x0000000100020001ULL,
      0};

  explicit HeadingCosts(std::uint64_t four) : four_(four) {}

  std::uint64_t four_ = 0;
};

}  // namespace split_mapf
