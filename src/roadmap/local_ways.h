#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "roadmap/clear_space.h"
#include "roadmap/draft.h"

namespace split_mapf::roadmap {

/// Searches over cells that cost what they look at, whatever the map's size.
class LocalWays {
 public:
  explicit LocalWays(const ClearSpace& space);

  /// The cheapest way from a cell to one that holds a vertex of the main piece, dearer near
  /// obstacles, along neighbouring clear cells; a diagonal step needs the cells beside it clear, so
  /// that the way stays in one piece of the free space. Nothing where there is none within
  /// `most_cells` cells looked at. Dijkstra 1959.
  std::optional<std::vector<Cell>> toMain(Cell from, const Draft& draft, std::size_t most_cells);

 private:
  struct Open {
    std::uint32_t cost;
    std::uint32_t cell;
    friend bool operator>(const Open& a, const Open& b) {
      return a.cost != b.cost ? a.cost > b.cost : a.cell > b.cell;
    }
  };

  std::uint32_t weightOf(std::size_t cell) const;
  void expand(const Open& from);
  std::vector<Cell> wayBack(std::uint32_t cell) const;
  void reset();

  const ClearSpace& space_;
  std::int32_t tight_;
  std::int32_t near_;
  std::int32_t roomy_;
  std::vector<std::uint32_t> costs_;
  std::vector<std::uint8_t> came_;
  std::vector<std::uint32_t> touched_;
  std::vector<Open> open_;  // a heap
};

}  // namespace split_mapf::roadmap
