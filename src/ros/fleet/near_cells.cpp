#include "ros/fleet/near_cells.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace split_mapf {
namespace {

/// Cells' centres, by squares whose sides are as long as the distance that is asked for.
class CentreSquares {
 public:
  CentreSquares(const std::vector<Cell>& cells, double resolution_m, double distance_m)
      : side_m_(distance_m) {
    for (const Cell cell : cells) {
      const PlanePoint centre{(cell.x + 0.5) * resolution_m, (cell.y + 0.5) * resolution_m};
      squares_[keyOf(squareOf(centre.x), squareOf(centre.y))].push_back(centre);
    }
  }

  bool isAnyNear(PlanePoint p, PlanePoint q) const {
    const std::int64_t right = squareOf(std::max(p.x, q.x)) + 1;
    const std::int64_t top = squareOf(std::max(p.y, q.y)) + 1;
    for (std::int64_t y = squareOf(std::min(p.y, q.y)) - 1; y <= top; ++y) {
      for (std::int64_t x = squareOf(std::min(p.x, q.x)) - 1; x <= right; ++x) {
        if (isAnyOfSquareNear(keyOf(x, y), p, q)) return true;
      }
    }
    return false;
  }

 private:
  bool isAnyOfSquareNear(std::int64_t key, PlanePoint p, PlanePoint q) const {
    const auto square = squares_.find(key);
    if (square == squares_.end()) return false;
    return std::any_of(square->second.begin(), square->second.end(),
                       [&](PlanePoint centre) { return distanceTo(centre, p, q) < side_m_; });
  }

  std::int64_t squareOf(double at_m) const {
    return static_cast<std::int64_t>(std::floor(at_m / side_m_));
  }

  static std::int64_t keyOf(std::int64_t x, std::int64_t y) { return y * kStride + x; }

  static constexpr std::int64_t kStride = std::int64_t{1} << 32;

  double side_m_;
  std::unordered_map<std::int64_t, std::vector<PlanePoint>> squares_;
};

}  // namespace

std::vector<bool> verticesNear(const CloseMoves& moves, Vertex vertices,
                               const std::vector<Cell>& cells, double resolution_m,
                               double distance_m) {
  std::vector<bool> near(vertices, false);
  if (cells.empty()) return near;
  // Anywhere in the cell.
  const CentreSquares centres(cells, resolution_m, distance_m + resolution_m * std::sqrt(0.5));
  for (MoveId move = 0; move < moves.moves(); ++move) {
    const Vertex from = moves.from(move);
    const Vertex to = moves.to(move);
    if (from > to || (near[from] && near[to])) continue;
    if (centres.isAnyNear(moves.place(from), moves.place(to))) near[from] = near[to] = true;
  }
  return near;
}

}  // namespace split_mapf
