#pragma once

#include <cstdint>
#include <vector>

#include "roadmap/chain_insertion.h"
#include "roadmap/chain_search.h"
#include "roadmap/clear_space.h"
#include "roadmap/lattice.h"
#include "roadmap/local_ways.h"
#include "roadmap/unreached.h"
#include "roadmap/wavefront.h"
#include "split_mapf/core/deadline.h"

namespace split_mapf::roadmap {

/// Lays chains of vertices through the passages that a lattice misses, until none reaches more.
class Passages {
 public:
  /// @param areas  the pieces of the free space
  Passages(const ClearSpace& space, const Pieces& areas, const CellGraph& lattice,
           const GraphScale& scale, const Deadline& deadline);

  /// @return false when the deadline struck
  bool lay(const Deadline& deadline);
  std::uint64_t covered() const { return coverage_.covered(); }
  std::uint32_t mainSize() const { return main_.size(); }
  /// The graph as it stands: vertices in the order of their cells; those of other pieces that have
  /// no edge left out.
  CellGraph graph() const;

 private:
  bool joinPieces(const Deadline& deadline);
  bool fillBlobs(const Deadline& deadline);
  bool layInto(const Blob& blob);
  bool layTowards(Cell target);
  bool layWithRepair(const Chain& chain);
  void repair(std::vector<std::uint32_t> severed);
  bool startPiece(Cell at);
  void closeLoops();

  const ClearSpace& space_;
  GraphScale scale_;
  Draft draft_;
  Coverage coverage_;
  MainPiece main_;
  ChainSearch search_;
  ChainInsertion insertion_;
  LocalWays ways_;
  Unreached unreached_;
  Wavefront wave_;
  std::uint32_t lattice_size_;
  std::size_t most_cells_;  // that a search for a way may look at
};

}  // namespace split_mapf::roadmap
