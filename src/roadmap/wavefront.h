#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "roadmap/clear_space.h"
#include "roadmap/coverage.h"
#include "roadmap/draft.h"
#include "split_mapf/core/deadline.h"

namespace split_mapf::roadmap {

/// Spreads from what the main piece covers over what it does not, breadth first, and tells which
/// vertices of other pieces it comes to. What joins the main piece meanwhile becomes ground to
/// spread from, so that a map is looked at once, however many pieces join.
class Wavefront {
 public:
  Wavefront(const ClearSpace& space, const Coverage& coverage, const Draft& draft,
            std::uint32_t reach);

  /// Spreads from all that is covered. Cost: O(cells).
  void startEverywhere(const Deadline& deadline);
  /// Spreads from what a vertex that joined covers, too. Cost: O(reach^2).
  void startAround(Cell vertex);
  /// The next cell that holds a vertex of another piece. Each is told once.
  std::optional<Cell> nextVertex();

 private:
  bool isOpen(std::size_t cell) const { return space_.isClear(cell) && !coverage_.isCovered(cell); }
  bool touchesCovered(std::uint32_t cell) const;
  void push(std::uint32_t cell);
  void spread(std::uint32_t cell);

  const ClearSpace& space_;
  const Coverage& coverage_;
  const Draft& draft_;
  std::int32_t reach_;
  std::vector<std::uint8_t> seen_;
  std::vector<std::uint32_t> queue_;
  std::size_t next_ = 0;
};

}  // namespace split_mapf::roadmap
