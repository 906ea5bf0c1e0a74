#include "split_mapf/split/time_split.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "split/intermediate_states.h"
#include "split_mapf/core/error.h"

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

// Steps of a piece's time that robots may walk with TimeSplitVariant::kAhead. Measured with `8t` on
// den520d (500 robots) and ost003d (300): sums of costs 1.04 and 1.06 times the bound, 1.7 and 1.8
// where everybody walks its share only; with 0.95 the makespan bound was missed on some of them.
constexpr double kAheadShare = 0.9;

std::uint32_t targetOf(std::uint32_t length, double ratio, TimeShare share,
                       TimeSplitVariant variant) {
  if (variant == TimeSplitVariant::kSumOfCosts) return std::min(length, share.piece);
  const auto own_share = static_cast<std::uint32_t>(std::lround(length * ratio));
  if (variant != TimeSplitVariant::kAhead) return own_share;
  const auto ahead = static_cast<std::uint32_t>(share.piece * kAheadShare);
  return std::max(own_share, std::min(length, ahead));
}

std::vector<std::uint32_t> targets(const Instance& instance, const std::vector<Vertex>& from,
                                   double ratio, TimeShare share, TimeSplitVariant variant) {
  std::vector<std::uint32_t> target(instance.robots());
  for (std::uint32_t i = 0; i < instance.robots(); ++i) {
    target[i] = targetOf(instance.distances(i)(from[i]), ratio, share, variant);
  }
  return target;
}

// Ways that are drawn beforehand make states less even than a look at all candidates. Where robots
// fill a fifth of the cells that costs: random-32-32-20 with 150 robots has makespans of 1.048
// times the bound in four pieces, instead of 1.040.
constexpr std::uint32_t kCellsARobot = 20;

std::vector<Path> drawShortestWays(const Instance& instance, std::uint64_t seed,
                                   const Deadline& deadline) {
  std::vector<Path> ways;
  ways.reserve(instance.robots());
  for (std::uint32_t i = 0; i < instance.robots() && !deadline.expired(); ++i) {
    ways.push_back(drawShortestWay(instance, i, seed));
  }
  return ways;
}

// After so many refused draws a seam is given up.
constexpr std::uint32_t kMostDraws = 8;

/// Draws the seams of one time split, one after another.
class SeamDrawer {
 public:
  SeamDrawer(const Instance& instance, const TimeSplitOptions& options, const Deadline& deadline,
             std::vector<Path> ways)
      : instance_(instance),
        options_(options),
        deadline_(deadline),
        states_(instance),
        engine_(options.seed) {
    if (!ways.empty()) states_.follow(std::move(ways));
  }

  /// Where the robots are after a piece that takes `ratio` of the time left; empty when no draw
  /// was solvable or the deadline expired.
  std::vector<Vertex> draw(const std::vector<Vertex>& from, std::uint32_t left, double ratio) {
    TimeShare share;
    share.piece = shareOf(left, ratio);
    share.rest = left - share.piece;
    const auto wanted = targets(instance_, from, ratio, share, options_.variant);
    for (std::uint32_t attempt = 0; attempt < kMostDraws; ++attempt) {
      if (attempt > 0) states_.drawWaysAgain();
      const auto target = loosen(wanted, attempt);
      std::vector<Vertex> to = options_.assignment == StateAssignment::kGreedy
                                   ? states_.choose(from, target, share, engine_, deadline_)
                                   : states_.match(from, target, share, engine_, deadline_);
      if (to.empty() || options_.checker == nullptr) return to;
      // Moves can be undone: what is reachable from here leads on to the goals.
      if (options_.checker->check(from, to, deadline_).answer == Solvability::kSolvable) return to;
    }
    return {};
  }

 private:
  /// Moves every target by up to `tolerance` steps.
  std::vector<std::uint32_t> loosen(std::vector<std::uint32_t> target, std::uint32_t tolerance) {
    if (tolerance == 0) return target;
    for (std::uint32_t& steps : target) {
      steps += static_cast<std::uint32_t>(drawBelow(engine_, 2 * tolerance + 1));
      steps -= std::min(steps, tolerance);
    }
    return target;
  }

  const Instance& instance_;
  const TimeSplitOptions& options_;
  const Deadline& deadline_;
  IntermediateStates states_;
  RandomEngine engine_;
};

Piece makePiece(const Instance& whole, const std::vector<Vertex>& from,
                const std::vector<Vertex>& to, std::size_t number) {
  Piece piece;
  piece.robots.resize(whole.robots());
  std::iota(piece.robots.begin(), piece.robots.end(), 0U);
  // A piece's robots see little of the map, and pieces are solved in threads of their own.
  piece.instance = std::make_shared<const Instance>(Instance::stretchOf(whole, from, to));
  piece.phase = static_cast<std::uint32_t>(number);
  return piece;
}

/// Halves the instance and then each half, until there are as many pieces as ratios.
std::optional<std::vector<Piece>> bisect(const Instance& instance, TimeSplitOptions options,
                                         const Deadline& deadline, std::vector<Path> ways) {
  const std::size_t pieces = options.ratios.size();
  if ((pieces & (pieces - 1)) != 0) {
    throw OptionError("variant=bisection needs a power of two of pieces, not " +
                      std::to_string(pieces));
  }
  options.ratios = {0.5, 0.5};
  std::optional<std::vector<Piece>> halves =
      splitTime(instance, options, deadline, std::move(ways));
  if (!halves || pieces == 2) return halves;
  options.ratios.assign(pieces / 2, 2.0 / static_cast<double>(pieces));
  std::vector<Piece> parts;
  for (const Piece& half : *halves) {
    auto quarters = splitTime(*half.instance, options, deadline);
    if (!quarters) return std::nullopt;
    for (Piece& part : *quarters) {
      part.phase = static_cast<std::uint32_t>(parts.size());
      parts.push_back(std::move(part));
    }
  }
  return parts;
}

}  // namespace

bool followsShortestWays(const Instance& instance, const TimeSplitOptions& options) {
  return options.assignment == StateAssignment::kGreedy &&
         instance.robots() <= instance.graph().size() / kCellsARobot;
}

std::optional<std::vector<Piece>> splitTime(const Instance& instance,
                                            const TimeSplitOptions& options,
                                            const Deadline& deadline, std::vector<Path> ways) {
  if (options.variant == TimeSplitVariant::kBisection && options.ratios.size() > 2) {
    return bisect(instance, options, deadline, std::move(ways));
  }
  if (!followsShortestWays(instance, options))
    ways.clear();
  else if (ways.empty())
    ways = drawShortestWays(instance, options.seed, deadline);
  if (deadline.expired()) return std::nullopt;
  SeamDrawer drawer(instance, options, deadline, std::move(ways));
  std::vector<Piece> pieces;
  std::vector<Vertex> from = instance.starts();
  double open = std::accumulate(options.ratios.begin(), options.ratios.end(), 0.0);
  double due = 0;  // shares of the time that the next piece takes: more than one after a lost seam
  for (std::size_t j = 0; j + 1 < options.ratios.size(); ++j) {
    const std::uint32_t left = remainingSteps(instance, from);
    if (left == 0) break;
    due += options.ratios[j];
    const std::vector<Vertex> to = drawer.draw(from, left, due / open);
    if (deadline.expired()) return std::nullopt;
    if (to.empty() || to == from) continue;
    pieces.push_back(makePiece(instance, from, to, pieces.size()));
    open -= due;
    due = 0;
    from = to;
  }
  if (pieces.empty() || from != instance.goals()) {
    pieces.push_back(makePiece(instance, from, instance.goals(), pieces.size()));
  }
  return pieces;
}

}  // namespace split_mapf
