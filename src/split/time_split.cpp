#include "split_mapf/split/time_split.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "split/intermediate_states.h"

namespace split_mapf {
namespace {

/// The longest way that a robot still has.
std::uint32_t remainingSteps(const Instance& instance, const std::vector<Vertex>& from) {
  std::uint32_t longest = 0;
  for (std::uint32_t i = 0; i < instance.robots(); ++i) {
    longest = std::max(longest, instance.distances(i)(from[i]));
  }
  return longest;
}

/// ceil(total * ratio), where rounding errors of the ratio do not count as a step.
std::uint32_t shareOf(std::uint32_t total, double ratio) {
  return std::min(total, static_cast<std::uint32_t>(std::ceil(total * ratio - 1e-9)));
}

std::vector<std::uint32_t> targets(const Instance& instance, const std::vector<Vertex>& from,
                                   double ratio, TimeShare share, TimeSplitVariant variant) {
  std::vector<std::uint32_t> target(instance.robots());
  for (std::uint32_t i = 0; i < instance.robots(); ++i) {
    const std::uint32_t length = instance.distances(i)(from[i]);
    target[i] = variant == TimeSplitVariant::kMakespan
                    ? static_cast<std::uint32_t>(std::lround(length * ratio))
                    : std::min(length, share.piece);
  }
  return target;
}

}  // namespace

std::optional<Decomposition> splitTime(const Instance& instance, const TimeSplitOptions& options,
                                       const Deadline& deadline) {
  IntermediateStates states(instance);
  RandomEngine engine(options.seed);
  std::vector<std::uint32_t> everyone(instance.robots());
  std::iota(everyone.begin(), everyone.end(), 0U);
  std::vector<Decomposition> pieces;
  std::vector<Vertex> from = instance.starts();
  const std::size_t count = options.ratios.size();
  for (std::size_t j = 0; j < count; ++j) {
    const std::uint32_t left = remainingSteps(instance, from);
    if (left == 0 && !pieces.empty()) break;
    const bool last = j + 1 == count;
    std::vector<Vertex> to = instance.goals();
    if (!last) {
      const double open = std::accumulate(options.ratios.begin() + static_cast<std::ptrdiff_t>(j),
                                          options.ratios.end(), 0.0);
      const double ratio = options.ratios[j] / open;
      TimeShare share;
      share.piece = shareOf(left, ratio);
      share.rest = left - share.piece;
      to = states.choose(from, targets(instance, from, ratio, share, options.variant), share,
                         engine, deadline);
      if (to.empty()) return std::nullopt;
      if (to == from) continue;
    }
    Instance piece = Instance::fromVertices(instance.sharedGrid(), from, to);
    for (std::uint32_t i = 0; i < instance.robots(); ++i) {
      if (to[i] == instance.goal(i)) piece.adoptDistances(i, instance.shareDistances(i));
    }
    pieces.push_back(
        Decomposition::leaf(std::move(piece), everyone, static_cast<std::uint32_t>(pieces.size())));
    from = std::move(to);
  }
  return Decomposition::sequence(std::move(pieces));
}

}  // namespace split_mapf
