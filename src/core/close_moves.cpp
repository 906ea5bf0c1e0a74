#include "split_mapf/core/close_moves.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <unordered_map>

namespace split_mapf {
namespace {

// Touching counts as apart within this; the proof of planning graphs has half of it.
constexpr double kTouchM = 2e-6;
constexpr int kHalvings = 40;

PlanePoint between(PlanePoint a, PlanePoint b, double part) {
  return {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)};
}

/// Where along a move a convex function is least.
template <typename Function>
double leastAt(const Function& value) {
  double low = 0;
  double high = 1;
  for (int i = 0; i < kHalvings; ++i) {
    const double third = (high - low) / 3;
    if (value(low + third) <= value(high - third)) {
      high -= third;
    } else {
      low += third;
    }
  }
  return (low + high) / 2;
}

/// Edges by the square in which their middle lies, so that near ones are found.
class EdgeSquares {
 public:
  EdgeSquares(const std::vector<PlanePoint>& middles, double side) : side_(side) {
    for (std::uint32_t i = 0; i < middles.size(); ++i)
      squares_[keyOf(middles[i], 0, 0)].push_back(i);
  }

  template <typename Visitor>
  void visitAround(PlanePoint middle, const Visitor& visit) const {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const auto square = squares_.find(keyOf(middle, dx, dy));
        if (square == squares_.end()) continue;
        for (const std::uint32_t edge : square->second) visit(edge);
      }
    }
  }

 private:
  std::uint64_t keyOf(PlanePoint p, int dx, int dy) const {
    const auto column = static_cast<std::int64_t>(std::floor(p.x / side_)) + dx;
    const auto row = static_cast<std::int64_t>(std::floor(p.y / side_)) + dy;
    return (static_cast<std::uint64_t>(row) << 32U) ^
           (static_cast<std::uint64_t>(column) & 0xffffffffU);
  }

  double side_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> squares_;
};

/// All pairs of close moves of a graph.
class PairSearch {
 public:
  PairSearch(const CloseMoves& moves, double distance_m) : moves_(moves), distance_m_(distance_m) {}

  std::vector<CloseMoves::Pair> run() {
    std::vector<MoveId> edges;
    std::vector<PlanePoint> middles;
    double longest = 0;
    for (MoveId move = 0; move < moves_.moves(); ++move) {
      if (moves_.from(move) > moves_.to(move)) continue;
      const PlanePoint a = moves_.place(moves_.from(move));
      const PlanePoint b = moves_.place(moves_.to(move));
      edges.push_back(move);
      middles.push_back(between(a, b, 0.5));
      longest = std::max(longest, std::hypot(b.x - a.x, b.y - a.y));
    }
    if (edges.empty()) return {};
    const EdgeSquares squares(middles, longest + distance_m_ + kTouchM);
    for (std::uint32_t i = 0; i < edges.size(); ++i) {
      squares.visitAround(middles[i], [&](std::uint32_t j) {
        if (i != j) weigh(edges[j], edges[i]);
      });
    }
    return std::move(pairs_);
  }

 private:
  /// Both directions of one edge before both of another.
  void weigh(MoveId edge, MoveId other) {
    weighOne(moves_.from(edge), moves_.to(edge), other);
    weighOne(moves_.to(edge), moves_.from(edge), other);
  }

  void weighOne(Vertex from, Vertex to, MoveId other) {
    const Vertex a = moves_.from(other);
    const Vertex b = moves_.to(other);
    if (to == a || to == b) return;
    const bool follows = from == a || from == b;
    const double release = follows ? releaseOfFollower(from, to, from == a ? b : a)
                                   : releaseFraction(moves_.place(from), moves_.place(to),
                                                     moves_.place(a), moves_.place(b), distance_m_);
    if (release <= 0 && !follows) return;
    if (release > 1) refuse(to, a, b);
    const MoveId before = moves_.moveOf(from, to);
    const auto part = static_cast<float>(std::min(1.0, release + 1e-7));
    pairs_.push_back({before, other, part});
    pairs_.push_back({before, moves_.moveOf(b, a), part});
  }

  double releaseOfFollower(Vertex via, Vertex to, Vertex other) const {
    const PlanePoint far = moves_.place(other);
    const PlanePoint end = moves_.place(to);
    const double release = releaseFraction(far, moves_.place(via), end, distance_m_);
    const bool touches = distanceTo(end, far, moves_.place(via)) >= distance_m_ - kTouchM;
    return touches ? std::min(1.0, release) : release;
  }

  [[noreturn]] void refuse(Vertex v, Vertex a, Vertex b) const {
    const double there = distanceTo(moves_.place(v), moves_.place(a), moves_.place(b));
    throw std::invalid_argument("vertex " + std::to_string(v) + " is " + std::to_string(there) +
                                " m from the edge between " + std::to_string(a) + " and " +
                                std::to_string(b) + ", " + std::to_string(distance_m_) +
                                " m are needed");
  }

  const CloseMoves& moves_;
  double distance_m_;
  std::vector<CloseMoves::Pair> pairs_;
};

}  // namespace

double distanceTo(PlanePoint p, PlanePoint a, PlanePoint b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double square = dx * dx + dy * dy;
  const double along = square > 0 ? ((p.x - a.x) * dx + (p.y - a.y) * dy) / square : 0;
  const PlanePoint foot = between(a, b, std::clamp(along, 0.0, 1.0));
  return std::hypot(p.x - foot.x, p.y - foot.y);
}

double releaseFraction(PlanePoint from, PlanePoint to, PlanePoint a, PlanePoint b,
                       double distance) {
  const auto gap = [&](double part) { return distanceTo(between(from, to, part), a, b); };
  const double end = gap(1);
  if (end < distance - kTouchM) return 2;
  if (end < distance) return 1;
  double near = leastAt(gap);
  if (gap(near) >= distance) return 0;
  double far = 1;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (near + far) / 2;
    (gap(middle) < distance ? near : far) = middle;
  }
  return far;
}

CloseMoves::CloseMoves(const Graph& graph, std::vector<PlanePoint> places)
    : places_(std::move(places)) {
  offsets_.push_back(0);
  for (Vertex v = 0; v < graph.size(); ++v) {
    for (const Vertex next : graph.neighbours(v)) {
      sources_.push_back(v);
      targets_.push_back(next);
    }
    offsets_.push_back(moves());
  }
}

CloseMoves::CloseMoves(const Graph& graph, std::vector<PlanePoint> places, double distance_m)
    : CloseMoves(graph, std::move(places)) {
  take(PairSearch(*this, distance_m).run());
}

CloseMoves::CloseMoves(const Graph& graph, std::vector<PlanePoint> places,
                       const std::vector<Pair>& pairs)
    : CloseMoves(graph, std::move(places)) {
  take(pairs);
}

void CloseMoves::take(std::vector<Pair> pairs) {
  std::sort(pairs.begin(), pairs.end(), [](const Pair& one, const Pair& two) {
    return std::make_pair(one.after, one.before) < std::make_pair(two.after, two.before);
  });
  first_.assign(moves() + std::size_t{1}, 0);
  for (const Pair& pair : pairs) {
    ++first_[pair.after + 1];
    close_.push_back({pair.before, pair.release});
  }
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
}

std::vector<Vertex> CloseMoves::nearTo(PlanePoint a, PlanePoint b, double distance_m) const {
  std::vector<Vertex> ends;
  const PlanePoint middle = between(a, b, 0.5);
  const double reach = std::hypot(b.x - a.x, b.y - a.y) / 2 + distance_m;
  for (MoveId move = 0; move < moves(); ++move) {
    if (from(move) > to(move)) continue;
    const PlanePoint p = place(from(move));
    const PlanePoint q = place(to(move));
    if (distanceTo(middle, p, q) >= reach) continue;
    if (releaseFraction(a, b, p, q, distance_m) <= 0) continue;
    ends.push_back(from(move));
    ends.push_back(to(move));
  }
  return ends;
}

MoveId CloseMoves::moveOf(Vertex from, Vertex to) const {
  for (MoveId move = offsets_[from]; move < offsets_[from + 1]; ++move) {
    if (targets_[move] == to) return move;
  }
  return kNoMove;
}

}  // namespace split_mapf
