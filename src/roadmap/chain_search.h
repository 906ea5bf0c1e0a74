#pragma once

#include <cstdint>
#include <vector>

#include "roadmap/chain.h"
#include "roadmap/clear_space.h"
#include "roadmap/draft.h"
#include "roadmap/main_piece.h"
#include "roadmap/separation.h"

namespace split_mapf::roadmap {

/// Lengths of a planning graph [cells].
struct GraphScale {
  std::uint32_t spacing = 0;     ///< of the lattice
  double separation = 0;         ///< what the centres of two robots keep
  double shortest_edge = 0;      ///< of a chain
  double longest_edge = 0;       ///< of a chain
  std::uint32_t candidates = 0;  ///< cells from one place for a chain's vertex to the next
};

/// Picks the vertices of a chain from places along a way, by dynamic programming over pairs of
/// consecutive vertices: each edge clear, of a length within the scale's, every two edges in a row
/// keeping robots apart; the price is what has to go from the draft.
class ChainSearch {
 public:
  ChainSearch(const ClearSpace& space, const Draft& draft, const MainPiece& main,
              const GraphScale& scale);

  /// The cheapest chains first: one that ends at a vertex of another piece, as this brings the
  /// whole piece, and one that ends at a new vertex, where there are such.
  /// @param way  neighbouring cells, from what is to be reached to the main piece
  /// @param broad  whether places beside the way count, too: chains through narrower bends, at
  /// about ten times the cost
  std::vector<Chain> along(const std::vector<Cell>& way, bool broad);

 private:
  struct Place {
    Cell at;
    std::uint32_t vertex;  // of the draft, or kNoVertex
    double price;          // of a new vertex here
    double start_price;    // of a chain that begins here
  };
  struct Link {
    std::uint32_t from;
    std::uint32_t to;
    double price;
    double total;
    std::uint32_t before;  // the link before it on the cheapest chain
  };

  void addPlaces(const std::vector<Cell>& way, bool broad);
  void addPlacesBeside(const std::vector<Cell>& way, std::size_t i);
  void addPlace(Cell at, std::size_t steps);
  void addCorner(const std::vector<Cell>& way, std::size_t i);
  void addVerticesNear(Cell centre, bool main, std::uint32_t area);
  void addLinks(bool broad);
  bool hasRoom(std::uint32_t vertex) const;
  void offerLink(std::uint32_t from, std::uint32_t to);
  void relax(std::uint32_t link, bool joins);
  std::uint32_t cheapest(bool joins);
  double priceOf(const Obstruction& found) const;
  Chain chainTo(std::uint32_t link) const;

  const ClearSpace& space_;
  const Draft& draft_;
  const MainPiece& main_;
  GraphScale scale_;
  Separation separation_;
  ObstructionFinder finder_;
  std::vector<Place> places_;  // inner vertices, places along the way, outer vertices
  std::uint32_t first_on_way_ = 0;
  std::uint32_t first_outer_ = 0;
  std::vector<Link> links_;
  std::vector<std::vector<std::uint32_t>> arriving_;  // place -> links that end there
  Obstruction found_;
};

}  // namespace split_mapf::roadmap
