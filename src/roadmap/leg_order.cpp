#include "split_mapf/roadmap/leg_order.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

// Rows of the grid that stands for the legs' ends.
constexpr std::uint32_t kWidth = 1024;

PlanePoint planePoint(MapPoint p) { return {p.x, p.y}; }

Vertex startOf(std::uint32_t robot) { return 2 * robot; }
Vertex endOf(std::uint32_t robot) { return 2 * robot + 1; }

/// One call of orderLegs().
class Ordering {
 public:
  Ordering(const std::vector<DrivenLeg>& legs, double clearance_m,
           const std::vector<std::string>& names)
      : legs_(legs), clearance_m_(clearance_m), names_(names) {}

  LegOrder run() {
    std::uint32_t last_wave = 0;
    for (const DrivenLeg& leg : legs_) last_wave = std::max(last_wave, leg.wave);
    for (std::uint32_t wave = 0; wave <= last_wave; ++wave) placeWave(wave);
    return result();
  }

 private:
  bool hasLength(std::uint32_t robot) const {
    const DrivenLeg& leg = legs_[robot];
    return leg.from.x != leg.to.x || leg.from.y != leg.to.y;
  }

  double apart(std::uint32_t a, std::uint32_t b) const {
    return legs_[a].radius_m + legs_[b].radius_m + clearance_m_;
  }

  /// How much of a leg has to be driven before another one may.
  double releaseOf(std::uint32_t leg, std::uint32_t other) const {
    const DrivenLeg& a = legs_[leg];
    const DrivenLeg& b = legs_[other];
    const double far =
        std::hypot(a.from.x + a.to.x - b.from.x - b.to.x, a.from.y + a.to.y - b.from.y - b.to.y) /
        2;
    const double lengths = std::hypot(a.to.x - a.from.x, a.to.y - a.from.y) +
                           std::hypot(b.to.x - b.from.x, b.to.y - b.from.y);
    if (far - lengths / 2 >= apart(leg, other)) return 0;
    return releaseFraction(planePoint(a.from), planePoint(a.to), planePoint(b.from),
                           planePoint(b.to), apart(leg, other));
  }

  /// Whether a leg keeps off a place of another robot.
  bool keepsOff(std::uint32_t leg, std::uint32_t other, MapPoint place) const {
    const PlanePoint stands = planePoint(place);
    return releaseFraction(stands, stands, planePoint(legs_[leg].from), planePoint(legs_[leg].to),
                           apart(leg, other)) <= 1;
  }

  void placeWave(std::uint32_t wave) {
    std::vector<std::uint32_t> waiting;
    for (std::uint32_t i = 0; i < legs_.size(); ++i) {
      if (legs_[i].wave == wave && hasLength(i)) waiting.push_back(i);
    }
    while (!waiting.empty()) {
      const auto next = std::find_if(waiting.begin(), waiting.end(), [&](std::uint32_t robot) {
        return std::all_of(waiting.begin(), waiting.end(),
                           [&](std::uint32_t other) {
                             return other == robot || keepsOff(robot, other, legs_[other].from);
                           }) &&
               keepsOffThoseBefore(robot, wave);
      });
      if (next == waiting.end()) refuse(waiting);
      order_.push_back(*next);
      waiting.erase(next);
    }
  }

  /// Of those before in the wave; those of other waves are the plan's care.
  bool keepsOffThoseBefore(std::uint32_t robot, std::uint32_t wave) const {
    return std::all_of(order_.begin(), order_.end(), [&](std::uint32_t other) {
      return legs_[other].wave != wave || keepsOff(robot, other, legs_[other].to);
    });
  }

  [[noreturn]] void refuse(const std::vector<std::uint32_t>& waiting) const {
    std::string text = names_[waiting.front()];
    for (std::size_t i = 1; i < std::min<std::size_t>(waiting.size(), 3); ++i) {
      text += (i + 1 < waiting.size() ? ", " : " and ") + names_[waiting[i]];
    }
    if (waiting.size() > 3) text += " and others";
    throw InputError(text +
                     " keep apart between their poses and the planning graph only when they set "
                     "out at the same moment, which robots that may be late cannot");
  }

  LegOrder result() const {
    const auto robots = static_cast<std::uint32_t>(legs_.size());
    std::vector<std::uint32_t> cells(2 * std::size_t{robots});
    std::vector<PlanePoint> places(cells.size());
    std::vector<std::pair<Vertex, Vertex>> edges;
    LegOrder result;
    for (std::uint32_t i = 0; i < robots; ++i) {
      cells[startOf(i)] = startOf(i);
      cells[endOf(i)] = endOf(i);
      places[startOf(i)] = planePoint(legs_[i].from);
      places[endOf(i)] = planePoint(legs_[i].to);
      if (hasLength(i)) edges.emplace_back(startOf(i), endOf(i));
      result.plan.paths.push_back({hasLength(i) ? startOf(i) : endOf(i)});
    }
    for (std::uint32_t position = 0; position < order_.size(); ++position) {
      const std::uint32_t robot = order_[position];
      Path& path = result.plan.paths[robot];
      path.resize(position + std::size_t{1}, startOf(robot));
      path.push_back(endOf(robot));
    }
    const std::uint32_t rows = (2 * robots + kWidth - 1) / kWidth;
    result.grid = std::make_shared<const Grid>(kWidth, std::max(1U, rows), std::move(cells), edges);
    const CloseMoves none(result.grid->graph(), places, std::vector<CloseMoves::Pair>{});
    result.moves =
        std::make_shared<const CloseMoves>(result.grid->graph(), std::move(places), pairsOf(none));
    return result;
  }

  std::vector<CloseMoves::Pair> pairsOf(const CloseMoves& moves) const {
    std::vector<CloseMoves::Pair> pairs;
    for (std::size_t i = 0; i < order_.size(); ++i) {
      for (std::size_t j = i + 1; j < order_.size(); ++j) {
        const double release = releaseOf(order_[i], order_[j]);
        if (release <= 0) continue;
        if (release > 1) refuse({order_[i], order_[j]});
        pairs.push_back({moves.moveOf(startOf(order_[i]), endOf(order_[i])),
                         moves.moveOf(startOf(order_[j]), endOf(order_[j])),
                         static_cast<float>(std::min(1.0, release + 1e-7))});
      }
    }
    return pairs;
  }

  const std::vector<DrivenLeg>& legs_;
  double clearance_m_;
  const std::vector<std::string>& names_;
  std::vector<std::uint32_t> order_;
};

}  // namespace

LegOrder orderLegs(const std::vector<DrivenLeg>& legs, double clearance_m,
                   const std::vector<std::string>& names) {
  return Ordering(legs, clearance_m, names).run();
}

}  // namespace split_mapf
