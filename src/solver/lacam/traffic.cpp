#include "solver/lacam/traffic.h"

#include <algorithm>

namespace split_mapf {

namespace {

// On maps of long ways more would take more memory than tables of steps.
constexpr std::size_t kMostSpans = 96;

}  // namespace

// Guides are a little longer than shortest ways; what comes after the last span counts in it.
Traffic::Traffic(const Instance& instance)
    : graph_(instance.graph()),
      spans_(std::min<std::size_t>(
          kMostSpans, std::size_t{delayed(makespanLowerBound(instance))} * 5 / 4 / kSpan + 2)),
      counts_(kDirections * spans_ * instance.graph().size()) {}

void Traffic::clear() { std::fill(counts_.begin(), counts_.end(), std::uint16_t{0}); }

std::size_t Traffic::place(Vertex from, Vertex to, std::size_t span) const {
  std::size_t direction = 0;
  for (const Vertex u : graph_.neighbours(to)) {
    if (u == from) break;
    ++direction;
  }
  return (span * graph_.size() + to) * kDirections + direction;
}

std::uint32_t Traffic::onto(Vertex v, std::uint32_t steps) const {
  const std::uint16_t* const counts = &counts_[(spanOf(steps) * graph_.size() + v) * kDirections];
  return std::uint32_t{counts[0]} + counts[1] + counts[2] + counts[3];
}

void Traffic::change(const Path& guide, int by) {
  for (std::uint32_t k = 1; k < guide.size(); ++k) {
    std::uint16_t& count = counts_[place(guide[k - 1], guide[k], spanOf(delayed(k)))];
    count = static_cast<std::uint16_t>(count + by);
  }
}

}  // namespace split_mapf
