#pragma once

#include <cstdint>
#include <vector>

#include "roadmap/coverage.h"
#include "roadmap/draft.h"
#include "roadmap/lattice.h"
#include "split_mapf/core/deadline.h"

namespace split_mapf::roadmap {

/// Which vertices of a draft belong to the piece that robots are to reach, one piece in each piece
/// of the free space, and what these cover. Kept up to date by looking only around a change.
class MainPiece {
 public:
  /// The largest piece of the draft in each piece of the free space is its main one.
  /// @param deadline  outlives this; whatever lets vertices join throws Interrupted when it
  /// strikes.
  MainPiece(Draft& draft, Coverage& coverage, const Pieces& areas, std::uint32_t width,
            const Deadline& deadline);

  /// The piece of the free space in which a cell lies. @pre the cell is clear
  std::uint32_t areaOf(Cell at) const {
    return areas_.of(static_cast<std::uint32_t>(at.y) * width_ + static_cast<std::uint32_t>(at.x));
  }
  bool inOneArea(Cell a, Cell b) const { return areaOf(a) == areaOf(b); }
  /// Number of its vertices.
  std::uint32_t size() const { return size_; }

  /// Takes in all that hangs together with the vertex `v`, itself included.
  void joinAround(std::uint32_t v);
  /// Lets a vertex go that is about to be removed.
  void leave(std::uint32_t v);
  /// After removals: `ends` are the main vertices that lost an edge. Parts that nothing holds to
  /// the rest any more leave, all but the largest of them in each area. Cost: the size of the
  /// smaller parts.
  void dropSevered(const std::vector<std::uint32_t>& ends);

  std::size_t mark() const { return log_.size(); }
  /// Calls visit(cell) for every vertex that joined since the mark.
  template <typename Visit>
  void visitJoined(std::size_t mark, const Visit& visit) const {
    for (std::size_t i = mark; i < log_.size(); ++i) {
      if (log_[i].joined) visit(log_[i].at);
    }
  }
  /// Takes back what changed since the mark, but for the draft's own marks. @pre the draft has not
  /// been taken back yet
  void undoTo(std::size_t mark);
  void commit() { log_.clear(); }

 private:
  struct Entry {
    Cell at;
    bool joined;
  };
  /// A search that goes out from one end; searches that met share a group.
  struct Front {
    std::uint32_t group;
    std::vector<std::uint32_t> reached;
    std::size_t next = 0;
    bool isSpent() const { return next == reached.size(); }
  };

  void join(std::uint32_t v);
  void dropSeveredInArea(const std::vector<std::uint32_t>& ends);
  void advance(std::vector<Front>& fronts, std::size_t i);
  std::vector<std::uint32_t> growUntilOneIsLeft(std::vector<Front>& fronts);
  std::uint32_t largestGroup(const std::vector<Front>& fronts) const;

  Draft& draft_;
  Coverage& coverage_;
  const Pieces& areas_;
  std::uint32_t width_;
  const Deadline& deadline_;
  std::uint32_t size_ = 0;
  std::vector<Entry> log_;
  std::vector<std::uint32_t> stamps_;  // vertex -> the search that reached it last
  std::vector<std::uint32_t> owners_;  // vertex -> the front that reached it
  std::uint32_t stamp_ = 0;
};

}  // namespace split_mapf::roadmap
