#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/solvability/solvability.h"
#include "split_mapf/split/piece_tree.h"

namespace split_mapf {

/// Where on its way a robot should be when a piece ends.
enum class TimeSplitVariant {
  kMakespan,    ///< at its share of its own way (the paper's Algorithm 1)
  kSumOfCosts,  ///< as far as the piece's time allows, home if that suffices (section III-B)
  /// In the middle, again and again: recursive halving into equal pieces, as in Yu and LaValle,
  /// T-RO 2016. The baseline that the paper improves on; the number of pieces is a power of two.
  kBisection,
  /// As far as nine tenths of the piece's time allow, or at its share of its way where that is
  /// farther. Ours, for makespan: only robots that need the whole time have none to spare, so that
  /// pieces still meet their bounds, and no robot is held back to walk along with the longest way.
  kAhead,
};

/// How intermediate states are given to robots.
enum class StateAssignment {
  kGreedy,    ///< robot after robot, the longest way first (the paper's Algorithm 1)
  kMatching,  ///< all at once, at the least total cost
};

struct TimeSplitOptions {
  std::vector<double> ratios;  ///< shares of the time, each > 0; k = ratios.size() pieces
  TimeSplitVariant variant = TimeSplitVariant::kMakespan;
  StateAssignment assignment = StateAssignment::kGreedy;
  std::uint64_t seed = 0;  ///< breaks ties between equally good intermediate states
  /// Of the instance's graph: only intermediate states that the robots can reach are taken. Null:
  /// no check, as the paper advises for low densities.
  const SolvabilityChecker* checker = nullptr;
};

/// Whether splitTime() cuts shortest ways drawn beforehand: where robots choose greedily and have
/// much room.
bool followsShortestWays(const Instance& instance, const TimeSplitOptions& options);
/// A shortest way of a robot from its start, its turns drawn by the seed. @pre it is not cut off.
/// Cost: little while the robot's distances are in the cache.
Path drawShortestWay(const Instance& instance, std::uint32_t robot, std::uint64_t seed);

/// Cuts an instance in time: at least one piece, each on the whole grid with all robots, each
/// ending in the intermediate states in which the next begins. They have no names yet. Source: Guo,
/// Han and Yu 2021, Algorithm 1. Deviations: intermediate states are chosen piece by piece from
/// where the robots then are; a candidate v of a robot at s with goal g is rated by how far d(s,v)
/// and d(v,g) exceed the steps T1 and T2 that this piece and the rest may take, then by its detour,
/// then by its distance from the robot's share. So pieces cost no step more than the whole where
/// free cells on shortest paths exist, which the paper's own widening (d(s,v) and d(v,g) together
/// one step off any grid vertex) does not reach. Equals are drawn by the seed. Where there is much
/// room a robot does not look at all candidates, but takes the best on a shortest way drawn
/// beforehand, which is as good as any, unless another robot has it. Intermediate states that the
/// checker refuses are drawn anew with wider tolerance, a few times; then that seam is left out, as
/// moves can be undone and so the pieces around it are solvable together. A piece in which no robot
/// has to move is left out. @return nothing when the deadline expired.
/// @param ways  every robot's drawShortestWay() with the seed, where followsShortestWays() and the
/// caller has threads to draw them with; empty: they are drawn here, to the same result.
/// @pre no robot is cut off from its goal. Cost: the steps of shortest paths, where they are
/// followed; else, and for robots whose state is taken, the cells on them, a robot and piece.
std::optional<std::vector<Piece>> splitTime(const Instance& instance,
                                            const TimeSplitOptions& options,
                                            const Deadline& deadline, std::vector<Path> ways = {});

}  // namespace split_mapf
