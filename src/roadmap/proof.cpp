#include "split_mapf/roadmap/proof.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "roadmap/proof_geometry.h"

namespace split_mapf {
namespace {

using proof::kToleranceM;
using proof::leastNorm;
using proof::Nearest;
using proof::Point;

/// What one robot does in one step.
struct Move {
  Vertex from;
  Vertex to;
};

class Proof {
 public:
  Proof(const ObstacleRaster& raster, const Roadmap& roadmap, const Deadline& deadline)
      : raster_(raster),
        roadmap_(roadmap),
        deadline_(deadline),
        size_(static_cast<Vertex>(roadmap.cells.size())),
        apart_(2 * roadmap.robot_radius_m + roadmap.clearance_m - kToleranceM),
        free_(roadmap.robot_radius_m + roadmap.clearance_m - kToleranceM) {}

  std::optional<std::string> run() {
    checkShape();
    if (fault_.empty()) checkMap();
    if (fault_.empty()) checkPairs();
    if (fault_.empty()) return std::nullopt;
    return fault_;
  }

 private:
  bool stopped(Vertex v) const { return v % 256 == 0 && deadline_.expired(); }

  void checkShape() {
    const std::size_t cells = std::size_t{roadmap_.width} * roadmap_.height;
    if (roadmap_.width != raster_.width || roadmap_.height != raster_.height ||
        raster_.blocked.size() != cells) {
      fault_ = "the graph is not of this map";
      return;
    }
    for (Vertex v = 0; v < size_; ++v) {
      const bool ascends = v == 0 || roadmap_.cells[v - 1] < roadmap_.cells[v];
      if (!ascends || roadmap_.cells[v] >= cells) {
        fault_ = "the cell of vertex " + std::to_string(v) + " is out of order or off the map";
        return;
      }
    }
    places_.reserve(size_);
    for (Vertex v = 0; v < size_; ++v) places_.push_back(placeOf(v));
    moves_.resize(size_);
    for (Vertex v = 0; v < size_; ++v) moves_[v].push_back(v);
    for (std::size_t i = 0; i < roadmap_.edges.size(); ++i) {
      const auto [a, b] = roadmap_.edges[i];
      if (a >= b || b >= size_ || (i > 0 && !(roadmap_.edges[i - 1] < roadmap_.edges[i]))) {
        fault_ = "edge " + std::to_string(i) + " is out of order or without its ends";
        return;
      }
      moves_[a].push_back(b);
      moves_[b].push_back(a);
    }
    for (Vertex v = 0; v < size_; ++v) {
      if (moves_[v].size() > 5) fault_ = nameOf(v) + " has more than four edges";
    }
  }

  // --- against the map ---

  void checkMap() {
    for (Vertex v = 0; v < size_ && fault_.empty(); ++v) {
      if (stopped(v)) return;
      for (const Vertex u : moves_[v]) {
        if (u >= v) checkWay(v, u);
      }
    }
  }

  void checkWay(Vertex v, Vertex u) {
    const Nearest nearest = proof::nearestTo(raster_, places_[v], places_[u], free_);
    if (nearest.distance_m >= free_) return;
    std::ostringstream text;
    text << "a robot that goes " << nameOf(v) << "-" << nameOf(u) << " comes within "
         << nearest.distance_m << " m of "
         << (nearest.border ? "the border of the map"
                            : "the obstacle at " + toString(nearest.obstacle))
         << ", " << free_ + kToleranceM << " m are needed";
    fault_ = text.str();
  }

  // --- against each other ---

  void checkPairs() {
    double longest = 0;
    lengths_.assign(size_, 0);
    for (Vertex v = 0; v < size_; ++v) {
      for (const Vertex u : moves_[v]) {
        lengths_[v] = std::max(lengths_[v], std::abs(places_[u] - places_[v]));
      }
      longest = std::max(longest, lengths_[v]);
    }
    const double bucket = std::max(longest + apart_, raster_.resolution_m);
    sortIntoBuckets(bucket);
    for (Vertex v = 0; v < size_ && fault_.empty(); ++v) {
      if (stopped(v)) return;
      const Point at = places_[v];
      const double far = apart_ + lengths_[v] + longest;
      const auto reach = static_cast<std::int64_t>(std::ceil(far / bucket));
      const auto column = static_cast<std::int64_t>(at.real() / bucket);
      const auto row = static_cast<std::int64_t>(at.imag() / bucket);
      for (std::int64_t y = std::max<std::int64_t>(0, row - reach); y <= row; ++y) {
        for (std::int64_t x = std::max<std::int64_t>(0, column - reach);
             x <= std::min(columns_ - 1, column + reach); ++x) {
          checkBucket(v, static_cast<std::size_t>(y * columns_ + x));
        }
      }
    }
  }

  void sortIntoBuckets(double bucket) {
    columns_ = static_cast<std::int64_t>(raster_.width * raster_.resolution_m / bucket) + 1;
    const auto rows = static_cast<std::int64_t>(raster_.height * raster_.resolution_m / bucket) + 1;
    buckets_.assign(static_cast<std::size_t>(columns_ * rows), {});
    for (Vertex v = 0; v < size_; ++v) {
      const Point at = places_[v];
      const auto i = static_cast<std::int64_t>(at.imag() / bucket) * columns_ +
                     static_cast<std::int64_t>(at.real() / bucket);
      buckets_[static_cast<std::size_t>(i)].push_back(v);
    }
  }

  /// All moves from `v` with all moves from earlier vertices of a bucket.
  void checkBucket(Vertex v, std::size_t bucket) {
    for (const Vertex u : buckets_[bucket]) {
      if (u >= v) break;  // in ascending order
      const double far = apart_ + lengths_[v] + lengths_[u];
      if (std::norm(places_[v] - places_[u]) >= far * far) continue;
      for (const Vertex to : moves_[v]) {
        for (const Vertex other_to : moves_[u]) checkMoves({v, to}, {u, other_to});
      }
    }
  }

  void checkMoves(Move move, Move other) {
    const bool exchange = move.to == other.from && other.to == move.from;
    if (move.to == other.to || exchange) return;  // the rules forbid it
    const double distance =
        leastNorm(places_[move.from] - places_[other.from], places_[move.to] - places_[other.to]);
    if (distance >= apart_) return;
    std::ostringstream text;
    text << "a robot that goes " << nameOf(move.from) << "-" << nameOf(move.to)
         << " and one that goes " << nameOf(other.from) << "-" << nameOf(other.to)
         << " come within " << distance << " m, " << apart_ + kToleranceM << " m are needed";
    fault_ = text.str();
  }

  // --- geometry and words ---

  Point placeOf(Vertex v) const {
    const std::uint32_t column = roadmap_.cells[v] % roadmap_.width;
    const std::uint32_t row = roadmap_.cells[v] / roadmap_.width;
    return {(column + 0.5) * raster_.resolution_m, (row + 0.5) * raster_.resolution_m};
  }

  std::string nameOf(Vertex v) const {
    return "(" + std::to_string(roadmap_.cells[v] % roadmap_.width) + "," +
           std::to_string(roadmap_.cells[v] / roadmap_.width) + ")";
  }

  const ObstacleRaster& raster_;
  const Roadmap& roadmap_;
  const Deadline& deadline_;
  Vertex size_;
  double apart_;
  double free_;
  std::string fault_;
  std::vector<Point> places_;
  std::vector<std::vector<Vertex>> moves_;  // vertex -> where a robot there may be a step later
  std::vector<double> lengths_;             // vertex -> the longest of these moves
  std::int64_t columns_ = 0;
  std::vector<std::vector<Vertex>> buckets_;
};

}  // namespace

std::optional<std::string> findUnsafe(const ObstacleRaster& raster, const Roadmap& roadmap,
                                      const Deadline& deadline) {
  return Proof(raster, roadmap, deadline).run();
}

}  // namespace split_mapf
