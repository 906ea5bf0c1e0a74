#pragma once

#include <cstdint>
#include <vector>

#include "search/stay.h"
#include "search/timeline.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// Who is where and when: for each vertex the visits to it, ordered by their begin. Visits of
/// different robots may overlap, as plans under construction have conflicts. Memory: one entry a
/// visit, whatever the horizon, and as much again for timelines once one is asked for. Not
/// thread-safe.
/// With a headway robots hold a vertex for so many steps more after they have left it: visits end
/// so much later, and nobody follows another any closer.
class PathTable {
 public:
  explicit PathTable(std::uint32_t vertices, std::uint32_t headway = 0)
      : headway_(headway), stays_(vertices) {}

  std::uint32_t headway() const { return headway_; }

  /// @pre the robot has no path in the table; the path ends at its arrival.
  void insert(std::uint32_t robot, const Path& path);
  /// Of robots 0, 1, ...: as insert() of each, with room for all. @pre the table is empty.
  void insertAll(const std::vector<Path>& paths);
  /// @pre `path` is what was inserted for the robot.
  void remove(std::uint32_t robot, const Path& path);
  /// Removes where the robot is after step `from`: its visit of then ends with this step, and leads
  /// nowhere. @pre `path` is what was inserted.
  void removeTail(std::uint32_t robot, const Path& path, std::uint32_t from);
  /// Undoes removeTail(), with a path that is the same up to `from` and leads on from there.
  void insertTail(std::uint32_t robot, const Path& path, std::uint32_t from);
  /// Removes what removeTail() left.
  void removeHead(std::uint32_t robot, const Path& path, std::uint32_t from);

  /// How many visits came and went so far: what changes of the table cost.
  std::uint64_t changes() const { return changes_; }

  const std::vector<Stay>& at(Vertex v) const { return stays_[v]; }
  /// The timeline that all visits at `v` make. Kept until a path through `v` comes or goes: a
  /// search meets thousands of vertices, a changed path touches hundreds.
  const Timeline& timeline(Vertex v) const;
  /// How many robots other than `robot` move from `to` to `from` while it would move from `from`
  /// to `to`, arriving at step `t`.
  std::uint32_t countSwaps(std::uint32_t robot, Vertex from, Vertex to, std::uint32_t t) const;

 private:
  std::vector<Stay>::iterator find(std::uint32_t robot, Vertex v, std::uint32_t begin);
  void insert(std::uint32_t robot, Vertex v, std::uint32_t begin, std::uint32_t end, Vertex next);
  void erase(std::uint32_t robot, Vertex v, std::uint32_t begin);
  void noteChange(Vertex v) {
    ++changes_;
    if (!timelines_.empty()) timelines_[v].clear();
  }
  /// The end of a visit that is known to the table.
  std::uint32_t heldUntil(std::uint32_t end) const {
    return end == kForever ? kForever : end + headway_;
  }

  std::uint32_t headway_;
  std::vector<std::vector<Stay>> stays_;
  std::uint64_t changes_ = 0;
  // By vertex, none before one is asked for; an empty one is to be built.
  mutable std::vector<Timeline> timelines_;
  mutable TimelineBuilder builder_;
};

/// A visit of a path, and the vertex that the robot comes from; kNoVertex for its first visit.
struct PathVisit {
  Vertex vertex;
  std::uint32_t begin;
  std::uint32_t end;
  Vertex before;
};

/// Calls note(stay, visit, swaps) for each placed visit that a path conflicts with, by meeting it
/// or by swapping places with it, in the order of the path. The rule of core/collision.h for whole
/// visits. Cost: O(visits to the path's vertices).
template <typename Note>
void forEachConflict(const PathTable& placed, const Path& path, Note note) {
  Vertex before = kNoVertex;
  forEachStay(path, [&](Vertex v, std::uint32_t begin, std::uint32_t end, Vertex) {
    const PathVisit visit{v, begin, end, before};
    for (const Stay& stay : placed.at(v)) {
      if (stay.begin >= end + placed.headway()) break;
      if (stay.end > begin) {
        note(stay, visit, false);
      } else if (stay.end == begin && before != kNoVertex && stay.next == before) {
        note(stay, visit, true);
      }
    }
    before = v;
  });
}

/// The placed robots that a path conflicts with: at a vertex, by a swap, or because one holds its
/// goal for good. Each once, in ascending order. Cost: O(visits to the path's vertices).
std::vector<std::uint32_t> robotsInTheWay(const PathTable& placed, const Path& path);

}  // namespace split_mapf
