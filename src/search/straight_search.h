#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "search/reservation_table.h"
#include "split_mapf/core/distance_table.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// Directions of a grid: 0 east, 1 south, 2 west, 3 north; 4: not turned anywhere yet.
using Heading = std::uint8_t;
constexpr Heading kNoHeading = 4;

/// Quarter turns from one heading to another.
inline std::uint32_t turnsBetween(Heading from, Heading to) {
  constexpr std::array<std::uint8_t, 4> kTurns = {0, 1, 2, 1};
  return from == kNoHeading || to == kNoHeading ? 0 : kTurns[(from + 4U - to) % 4U];
}

/// The neighbours of each vertex of a grid by heading.
class HeadingGraph {
 public:
  /// The grid outlives this object.
  explicit HeadingGraph(const Grid& grid);
  /// Whether every edge leads in one of the four directions, one edge each.
  bool isValid() const { return valid_; }
  Vertex next(Vertex v, Heading heading) const { return next_[4 * std::size_t{v} + heading]; }
  Cell cellOf(Vertex v) const { return grid_.cellOf(v); }
  Heading headingOf(Vertex from, Vertex to) const;

 private:
  const Grid& grid_;
  std::vector<Vertex> next_;
  bool valid_ = true;
};

/// Finds, for one robot among placed ones, a path that arrives at the same step with fewer turns.
/// Keeps its memory between calls; not thread-safe.
class StraightSearch {
 public:
  explicit StraightSearch(const HeadingGraph& graph, std::uint32_t vertices);
  /// @param placed  without the robot.
  /// @param more  turns that the path may have more than `own`, less one.
  /// @return an empty path where none has fewer turns than `own` and `more`.
  Path search(const Path& own, const DistanceTable& distances, const ReservationTable& placed,
              std::uint32_t more = 0);

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;
  static constexpr std::uint32_t kMostLoss = 62;

  /// What a search knows of a vertex. Bit b stands for the step `base` + b; of `free` there is one
  /// more than may be reached.
  struct Met {
    Vertex vertex = kNoVertex;
    std::int32_t base = 0;
    std::int32_t east = 0;  // cells to the goal
    std::int32_t south = 0;
    std::uint64_t free = 0;
    std::array<std::uint64_t, 5> reached = {};  // by heading
    std::array<std::uint32_t, 5> records = {kNone, kNone, kNone, kNone, kNone};
  };
  /// Steps that were reached at first with so many turns.
  struct Record {
    std::uint64_t bits;
    std::uint32_t turns;
    std::uint32_t next;
  };
  struct Item {
    std::uint32_t met;
    std::uint32_t turns;
    std::uint64_t bits;
    Heading heading;
  };

  void begin(const Path& own, std::uint32_t more);
  std::uint32_t meet(Vertex v);
  std::uint64_t freeBits(Vertex v, std::int32_t base) const;
  bool expand(const Item& item);
  std::uint32_t turnsLeft(const Met& met, Heading heading) const;
  std::uint64_t move(const Met& from, const Met& to, std::uint64_t bits) const;
  void push(const Item& item);
  std::uint32_t turnsAt(const Met& met, Heading heading, std::uint32_t bit) const;
  bool stepBack(std::uint32_t& met, Heading& heading, std::uint32_t& bit) const;
  Path pathTo(const Path& own, Heading heading) const;
  std::uint32_t shiftOf(const Met& from, const Met& to) const {
    return static_cast<std::uint32_t>(1 + from.base - to.base);
  }

  const HeadingGraph& graph_;
  const DistanceTable* distances_ = nullptr;
  const ReservationTable* placed_ = nullptr;
  std::uint32_t begin_ = 0;  // step from which the path is searched for
  std::uint32_t arrival_ = 0;
  std::uint32_t loss_ = 0;  // steps that may be lost on the way
  std::uint64_t mask_ = 0;  // of the bits in use
  Heading first_heading_ = kNoHeading;
  std::uint32_t most_turns_ = 0;
  Cell goal_;
  std::vector<std::uint32_t> slot_;   // by vertex
  std::vector<std::uint32_t> stamp_;  // by vertex: number of the search that met it
  std::uint32_t search_ = 0;
  std::vector<Met> met_;
  std::vector<Record> records_;
  std::vector<std::vector<Item>> levels_;  // by turns, with those that are left at the least
};

}  // namespace split_mapf
