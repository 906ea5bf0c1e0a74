#include "split_mapf/core/shortest_way.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace split_mapf {
namespace {

/// Four bits a cell, zero until set: its memory is taken where somebody sets one.
class Nibbles {
 public:
  explicit Nibbles(std::size_t count)
      : bytes_(static_cast<std::uint8_t*>(std::calloc(count / 2 + 1, 1)), &std::free) {
    if (!bytes_) throw std::bad_alloc();
  }
  unsigned get(std::size_t i) const { return bytes_.get()[i / 2] >> (i % 2 * 4) & 0xfU; }
  /// @pre it is zero.
  void set(std::size_t i, unsigned value) {
    std::uint8_t& byte = bytes_.get()[i / 2];
    byte = static_cast<std::uint8_t>(byte | value << (i % 2 * 4));
  }

 private:
  std::unique_ptr<std::uint8_t, decltype(&std::free)> bytes_;
};

struct Move {
  std::int32_t x;
  std::int32_t y;
};
// By what a cell remembers of how it was come to, less one.
constexpr std::array<Move, 4> kMoves = {Move{0, -1}, Move{-1, 0}, Move{1, 0}, Move{0, 1}};
constexpr unsigned kIsStart = 5;

/// A search from one cell to another. What is open lies on ways of one length; a move that does not
/// lead towards the end makes a way longer by two steps, and waits until all shorter ones are done.
class WaySearch {
 public:
  WaySearch(const Grid& grid, Vertex from, Vertex to, const Deadline& deadline)
      : grid_(grid),
        from_(grid.cellOf(from)),
        to_(grid.cellOf(to)),
        poll_(deadline),
        came_(std::size_t{grid.width()} * grid.height()) {}

  Path run() {
    settle(from_, kIsStart);
    while (came_.get(indexOf(to_)) == 0) {
      if (open_.empty()) lengthen();
      if (open_.empty()) return {};
      poll_();
      const std::uint32_t i = open_.back();
      open_.pop_back();
      expand(cellAt(i));
    }
    return wayBack();
  }

 private:
  std::uint32_t indexOf(Cell c) const {
    return static_cast<std::uint32_t>(c.y) * grid_.width() + static_cast<std::uint32_t>(c.x);
  }
  Cell cellAt(std::uint32_t i) const {
    return {static_cast<std::int32_t>(i % grid_.width()),
            static_cast<std::int32_t>(i / grid_.width())};
  }
  void settle(Cell c, unsigned came) {
    came_.set(indexOf(c), came);
    open_.push_back(indexOf(c));
  }

  void expand(Cell c) {
    for (unsigned k = 0; k < kMoves.size(); ++k) {
      const Cell next = {c.x + kMoves[k].x, c.y + kMoves[k].y};
      if (!grid_.isFree(next) || came_.get(indexOf(next)) != 0) continue;
      const bool is_closer = (to_.x - c.x) * kMoves[k].x > 0 || (to_.y - c.y) * kMoves[k].y > 0;
      if (is_closer) {
        settle(next, k + 1);
      } else {
        longer_.push_back(indexOf(next) << 2U | k);
      }
    }
  }

  /// Opens what lies on ways that are two steps longer, unless it was met on shorter ones since.
  void lengthen() {
    const std::vector<std::uint32_t> next = std::move(longer_);
    longer_.clear();
    for (const std::uint32_t entry : next) {
      poll_();
      const Cell c = cellAt(entry >> 2U);
      if (came_.get(indexOf(c)) == 0) settle(c, (entry & 3U) + 1);
    }
  }

  Path wayBack() const {
    Path path;
    Cell c = to_;
    for (;;) {
      path.push_back(grid_.vertexAt(c));
      const unsigned came = came_.get(indexOf(c));
      if (came == kIsStart) break;
      c = {c.x - kMoves[came - 1].x, c.y - kMoves[came - 1].y};
    }
    std::reverse(path.begin(), path.end());
    return path;
  }

  const Grid& grid_;
  const Cell from_;
  const Cell to_;
  SparsePoll poll_;
  Nibbles came_;
  std::vector<std::uint32_t> open_;
  std::vector<std::uint32_t> longer_;  // index of a cell, and the move that leads there
};

}  // namespace

Path findShortestWay(const Grid& grid, Vertex from, Vertex to, const Deadline& deadline) {
  return WaySearch(grid, from, to, deadline).run();
}

}  // namespace split_mapf
