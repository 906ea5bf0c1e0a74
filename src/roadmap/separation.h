#pragma once

#include <cstdint>

#include "split_mapf/core/grid.h"

namespace split_mapf::roadmap {

/// How near two discs come whose centres move straight between cells' centres, both in one whole
/// step. In cells, by whole numbers up to the last comparison.
class Separation {
 public:
  /// @param least  what two centres have to keep [cells]
  explicit Separation(double least) : least_(least), square_(least * least - 1e-7) {}

  double least() const { return least_; }
  /// Two discs that stand.
  bool standApart(Cell a, Cell b) const {
    return static_cast<double>(squared(a.x - b.x, a.y - b.y)) >= square_;
  }
  /// One stands at `p`, the other moves from `a` to `b`.
  bool passes(Cell p, Cell a, Cell b) const {
    return clearsOrigin(a.x - p.x, a.y - p.y, b.x - p.x, b.y - p.y);
  }
  /// One moves from `a` to `b`, the other from `c` to `d`.
  bool moveApart(Cell a, Cell b, Cell c, Cell d) const {
    return clearsOrigin(a.x - c.x, a.y - c.y, b.x - d.x, b.y - d.y);
  }
  /// Two edges without a common end, each in both directions.
  bool edgesApart(Cell a, Cell b, Cell c, Cell d) const {
    return moveApart(a, b, c, d) && moveApart(a, b, d, c);
  }
  /// One follows the other round the vertex `v`, either way, and stands at the one end while the
  /// other moves along the other edge.
  bool turnsApart(Cell u, Cell v, Cell w) const {
    return standApart(u, w) && moveApart(u, v, v, w) && passes(u, v, w) && passes(w, u, v);
  }

 private:
  static std::int64_t squared(std::int64_t x, std::int64_t y) { return x * x + y * y; }
  /// Whether the segment from p to q keeps away from the origin.
  bool clearsOrigin(std::int64_t px, std::int64_t py, std::int64_t qx, std::int64_t qy) const {
    const std::int64_t dx = qx - px;
    const std::int64_t dy = qy - py;
    const std::int64_t length = squared(dx, dy);
    const std::int64_t along = -(px * dx + py * dy);
    if (along <= 0) return static_cast<double>(squared(px, py)) >= square_;
    if (along >= length) return static_cast<double>(squared(qx, qy)) >= square_;
    const auto cross = static_cast<double>(px * dy - py * dx);
    return cross * cross >= square_ * static_cast<double>(length);
  }

  double least_;
  double square_;
};

}  // namespace split_mapf::roadmap
