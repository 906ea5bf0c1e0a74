#pragma once

#include <cstdint>
#include <vector>

#include "roadmap/chain.h"
#include "roadmap/chain_search.h"
#include "roadmap/clear_space.h"
#include "roadmap/coverage.h"
#include "roadmap/draft.h"
#include "roadmap/main_piece.h"

namespace split_mapf::roadmap {

/// Lays chains into a draft: what comes too near goes, and what lost an edge is tied to the chain
/// where it can be. Every change can be taken back.
class ChainInsertion {
 public:
  /// How far things have come.
  struct Mark {
    std::size_t draft;
    std::size_t main;
    std::uint64_t covered;  ///< cells
    std::uint32_t size;     ///< of the main piece
  };

  ChainInsertion(const ClearSpace& space, Draft& draft, MainPiece& main, Coverage& coverage,
                 const GraphScale& scale);

  /// @return false, and nothing is changed, when the chain comes too near to itself, takes away the
  /// vertex that it hangs on, or finds no room there
  bool insert(const Chain& chain);
  /// Vertices that the last inserted chain severed from the main piece, one or more a part.
  const std::vector<std::uint32_t>& severed() const { return severed_; }
  /// Adds an edge between two vertices of the draft where nothing is in its way. @return whether it
  /// did
  bool link(std::uint32_t a, std::uint32_t b);

  Mark mark() const;
  void undoTo(const Mark& mark);
  /// What robots reach beyond what they did at the mark [cells], less a price for places that went.
  double gainSince(const Mark& mark) const;
  /// Whether that is worth a change.
  bool isWorthIt(const Mark& mark) const;
  /// Makes all changes final.
  void commit();

 private:
  bool keepsApart(const std::vector<Cell>& row) const;
  bool clearTheWay(const Chain& chain, const std::vector<Cell>& row);
  void removeVertex(std::uint32_t v);
  void removeEdge(std::uint32_t a, std::uint32_t b);
  bool lay(const Chain& chain);
  void mend();

  const ClearSpace& space_;
  Draft& draft_;
  MainPiece& main_;
  Coverage& coverage_;
  GraphScale scale_;
  Separation separation_;
  ObstructionFinder finder_;
  Obstruction found_;
  double ground_;                    // cells that a vertex stands for, on average
  std::vector<std::uint32_t> row_;   // the chain as vertices of the draft
  std::vector<std::uint32_t> ends_;  // main vertices that lost an edge
  std::vector<std::uint32_t> severed_;
};

}  // namespace split_mapf::roadmap
