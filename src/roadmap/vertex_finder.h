#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "roadmap/clear_space.h"
#include "split_mapf/core/graph.h"
#include "split_mapf/roadmap/roadmap.h"

namespace split_mapf::roadmap {

/// The vertices of a planning graph by where they are, and the pieces that it falls into.
class VertexFinder {
 public:
  /// @pre the roadmap outlives this.
  explicit VertexFinder(const Roadmap& roadmap);

  Place placeOf(Vertex v) const;
  /// A name of the piece that a vertex belongs to.
  Vertex pieceOf(Vertex v) const { return pieces_[v]; }
  /// How many vertices it has.
  std::uint32_t sizeOf(Vertex piece) const { return sizes_[piece]; }
  /// Vertices within `reach` cells of a place, in ascending order.
  std::vector<Vertex> near(Place p, double reach) const;

 private:
  std::pair<std::int64_t, std::int64_t> bucketOf(Place p) const;

  const Roadmap& roadmap_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<Vertex>> buckets_;
  std::vector<Vertex> pieces_;
  std::vector<std::uint32_t> sizes_;
};

}  // namespace split_mapf::roadmap
