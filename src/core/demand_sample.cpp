#include "core/demand_sample.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/detour_search.h"
#include "split_mapf/core/distance_table.h"

namespace split_mapf {
namespace {

// Robots that are asked, one in so many, so that a sample in vain costs little.
constexpr std::uint32_t kMostAsked = 8;
constexpr std::uint32_t kOneIn = 25;
// Fitted on twenty maps: a vertex that is tried for nothing costs as much as so many of those
// that a table met, which come in pages; and on demand pays while both are less than this share of
// all.
constexpr double kVain = 14;
constexpr double kShareThatPays = 0.4;
constexpr double kBytesAVertex = 2;

/// What ways with few steps away from the goal cost in vain, at most: nothing where none is needed.
double costInVain(std::uint32_t length, std::uint32_t apart) {
  if (length == apart) return 0;
  return kVain * static_cast<double>(kMostOfFirstDetours * apart + kMostBesidesDetours);
}

class DemandSample {
 public:
  explicit DemandSample(const Problem& problem)
      : problem_(problem),
        asked_(std::min(kMostAsked, problem.robots() / kOneIn)),
        limit_(kShareThatPays * static_cast<double>(problem.grid->size()) * asked_) {}

  bool pays() const {
    if (asked_ == 0 || !problem_.grid->hasUnitMoves()) return false;
    if (problem_.grid->isHuge()) return false;  // its graph may not be there yet, nor be needed
    // In a maze the first distance takes as long as several tables of all: one of these tells.
    if (costOfDetours() > limit_) return false;
    double cost = 0;
    for (std::uint32_t i = 0; i < asked_; ++i) {
      cost += costOfFirst(robotAsked(i));
      if (cost > limit_) return false;
    }
    return true;
  }

 private:
  std::uint32_t robotAsked(std::uint32_t i) const {
    return static_cast<std::uint32_t>(std::uint64_t{problem_.robots()} * i / asked_);
  }
  Cell cellOf(Vertex v) const { return problem_.grid->cellOf(v); }

  /// Of the ways of all that are asked, were they all sent to the goal of the first.
  double costOfDetours() const {
    const Vertex goal = problem_.goals[robotAsked(0)];
    const DistanceTable all(problem_.grid->graph(), goal);
    double cost = 0;
    for (std::uint32_t i = 0; i < asked_; ++i) {
      const Vertex start = problem_.starts[robotAsked(i)];
      cost += costInVain(all(start), rowsAndColumns(cellOf(start), cellOf(goal)));
    }
    return cost;
  }
  /// Of a robot's first distance.
  double costOfFirst(std::uint32_t robot) const {
    const Vertex start = problem_.starts[robot];
    const Vertex goal = problem_.goals[robot];
    const DistanceTable table(goal, DistanceGuide{problem_.grid.get(), start, nullptr, true});
    const std::uint32_t length = table(start);
    const double met = static_cast<double>(table.bytes()) / kBytesAVertex;
    return met + costInVain(length, rowsAndColumns(cellOf(start), cellOf(goal)));
  }

  const Problem& problem_;
  const std::uint32_t asked_;
  const double limit_;
};

}  // namespace

bool paysOnDemand(const Problem& problem) { return DemandSample(problem).pays(); }

}  // namespace split_mapf
