#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/layout.h"
#include "split_mapf/split/partition.h"
#include "split_mapf/split/piece_tree.h"
#include "split_mapf/split/time_split.h"

namespace split_mapf {

/// How regions are made.
enum class PartitionKind {
  kAuto,        ///< rectangles where suitsRectangles(), dynamic elsewhere
  kRectangles,  ///< the paper's
  kDynamic,     ///< for any map
};

struct SpaceSplitOptions {
  std::uint32_t rows = 1;
  std::uint32_t columns = 1;
  PartitionKind partition = PartitionKind::kAuto;
  BufferSize buffer;
  StateAssignment assignment = StateAssignment::kMatching;
  double lambda1 = 3;             ///< weight of a step beyond T1 or T2
  double lambda2 = 4;             ///< weight of the local density rho
  std::uint32_t phase_steps = 0;  ///< T1 [steps]; 0: the time left over the phases left
  bool check = true;              ///< whether regions are checked for solvability
  std::uint64_t seed = 0;         ///< breaks ties
};

/// Cuts an instance in space: phases that follow each other, in each of which every robot stays in
/// the region that it starts the phase in. Two partitions take turns, and robots change regions by
/// ending a phase in a cell that has another owner in the next.
/// Source: Guo, Han and Yu 2021, Algorithms 2 and 3. Deviations: all distances are true shortest
/// ones; intermediate states of a region are matched to its robots at the least total of f
/// (StateAssignment::kGreedy: Algorithm 3, one after another); a robot bound for another region
/// ends in a cell whose next owner brings it closer, which covers all cases of Algorithm 2; T1 is
/// the time left over the phases left; the matching knows no order, so rho there is how narrow a
/// cell is and whether its neighbours may be taken. A region whose robots cannot all get to their
/// states is matched anew and then merged with a neighbour for that phase; merged to the whole
/// graph it takes the robots home. Ends when all are home.
class SpaceSplit {
 public:
  /// @pre no robot is cut off; `instance` outlives this object. @throws SplitSpecError when the
  /// regions do not fit the grid.
  SpaceSplit(const Instance& instance, const SpaceSplitOptions& options);
  ~SpaceSplit();
  SpaceSplit(const SpaceSplit&) = delete;
  SpaceSplit& operator=(const SpaceSplit&) = delete;

  /// Plans all phases ahead: where robots are after a phase depends on no plan. False when the
  /// deadline expired. Cost: O(robots * V) a phase and the matching.
  bool plan(const Deadline& deadline);

  const Layout& layout() const { return layout_; }
  /// Where the robots are when a phase begins.
  const std::vector<Vertex>& statesBefore(std::uint32_t phase) const;
  /// The pieces of a phase, by region; a region without robots has none.
  std::vector<Piece> piecesOf(std::uint32_t phase) const;
  /// The piece of a region on the region's own grid, its robots in ascending order; without a name.
  Piece pieceOf(std::uint32_t phase, std::uint32_t region) const;

  /// Draws other states for the robots of a region, which end in the same regions of the next phase
  /// as before. False when there are none (the last phase), or none that can be reached.
  bool rematch(std::uint32_t phase, std::uint32_t region, const Deadline& deadline);
  /// Merges a region with the neighbour that it touches most, for this phase only. @return the
  /// region that both are then; nothing when it has no neighbour.
  std::optional<std::uint32_t> mergeRegion(std::uint32_t phase, std::uint32_t region);
  /// Joins a phase with the next one (the last one: with the one before) into one on the whole
  /// graph. @pre there are at least two phases. @return the joint phase.
  std::uint32_t joinPhases(std::uint32_t phase);

 private:
  class Drawer;

  const Ownership& ownershipOf(std::uint32_t phase) const {
    return layout_.ownerships[layout_.phases[phase].ownership];
  }
  void drawPhase(std::uint32_t phase, const std::vector<Vertex>& from, const Deadline& deadline);
  void makeWhole(std::uint32_t phase);

  const Instance& instance_;
  SpaceSplitOptions options_;
  std::unique_ptr<Drawer> drawer_;
  Layout layout_;
};

}  // namespace split_mapf
