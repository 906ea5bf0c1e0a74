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

/// The lines of a grid: where each vertex has neighbours and how far one comes straight ahead.
class HeadingGraph {
 public:
  /// The grid outlives this object.
  explicit HeadingGraph(const Grid& grid);
  /// Whether every edge leads in one of the four directions, one edge each.
  bool isValid() const { return valid_; }
  Vertex next(Vertex v, Heading heading) const { return places_[v].next[heading]; }
  Heading headingOf(Vertex from, Vertex to) const;
  /// How many turns it takes at least from `v` to `goal`: 0, 1, or 2 for all that are more.
  std::array<std::uint8_t, 4> turnsLeft(Vertex v, Vertex goal) const;

 private:
  /// All of a vertex within half a cache line.
  struct alignas(32) Place {
    std::array<Vertex, 4> next = {kNoVertex, kNoVertex, kNoVertex, kNoVertex};  // by heading
    std::array<std::uint16_t, 4> run = {};  // cells to the last vertex straight ahead
    std::int16_t x = 0;                     // a grid has no more than 2^15 columns and rows
    std::int16_t y = 0;
  };

  void measureRun(Vertex v, Heading heading);

  std::vector<Place> places_;
  bool valid_ = true;
};

/// Which of several paths with as few turns is taken: the one that turns as soon as it can, or the
/// one that goes straight on as long as it can.
enum class TurnsLie { kEarly, kLate };

/// Finds, for one robot among placed ones, a path that arrives at the same step with fewer turns.
/// Keeps its memory between calls; not thread-safe.
class StraightSearch {
 public:
  explicit StraightSearch(const HeadingGraph& graph, std::uint32_t vertices);
  /// @param own  the path of the robot in the table.
  /// @param as_many  whether a path with as many turns will do, which may be `own`.
  /// @return an empty path where there is none.
  Path search(std::uint32_t robot, const Path& own, const DistanceTable& distances,
              const ReservationTable& placed, bool as_many = false,
              TurnsLie lie = TurnsLie::kEarly);

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;
  static constexpr std::uint32_t kMostLoss = 62;

  /// What is known of a vertex, each as long as its number is that of the search.
  struct Mark {
    std::uint32_t met_in = 0;
    std::uint32_t met = 0;     // place in met_
    std::uint32_t own_in = 0;  // the robot's own path leads there
  };
  /// What a search knows of a vertex. Bit b stands for the step `base` + b; of `free` there is one
  /// more than may be reached.
  struct alignas(64) Met {
    std::uint64_t free = 0;
    std::array<std::uint64_t, 4> reached = {};  // by heading
    Vertex vertex = kNoVertex;
    std::int32_t base = 0;
    std::array<std::uint8_t, 4> turns_left = {};  // at the least, by heading
  };
  /// Steps that were reached at first with so many turns.
  struct Record {
    std::uint64_t bits;
    std::uint32_t turns;
    std::uint32_t next;
  };
  struct Item {
    std::uint64_t bits;
    std::uint32_t met;
    std::uint32_t turns;
    Heading heading;
    bool turned;  // right here
  };
  /// A state at one step, on the way back.
  struct State {
    std::uint32_t met;
    std::uint32_t bit;
    Heading heading;
  };

  void begin(bool as_many);
  std::uint32_t meet(Vertex v);
  std::uint64_t freeBits(Vertex v, std::int32_t base) const;
  std::uint64_t ownBits(Vertex v, std::int32_t base) const;
  bool expand(const Item& item);
  void moveAhead(const Item& item, std::uint64_t bits);
  void turn(const Item& item, std::uint64_t bits);
  std::uint64_t move(const Met& from, const Met& to, std::uint64_t bits) const;
  void push(const Item& item);
  std::uint32_t turnsAt(const State& state) const;
  bool comeStraight(State& state) const;
  bool haveWaited(State& state) const;
  bool haveTurned(State& state) const;
  bool stepBack(State& state, TurnsLie lie) const;
  Path pathTo(Heading heading, TurnsLie lie) const;
  std::uint32_t shiftOf(const Met& from, const Met& to) const {
    return static_cast<std::uint32_t>(1 + from.base - to.base);
  }

  const HeadingGraph& graph_;
  const DistanceTable* distances_ = nullptr;
  const ReservationTable* placed_ = nullptr;
  std::uint32_t robot_ = 0;
  const Path* own_ = nullptr;
  std::uint32_t begin_ = 0;  // step from which the path is searched for
  std::uint32_t arrival_ = 0;
  std::uint32_t loss_ = 0;  // steps that may be lost on the way
  std::uint64_t mask_ = 0;  // of the bits in use
  Heading first_heading_ = kNoHeading;
  std::uint32_t most_turns_ = 0;
  std::uint32_t search_ = 0;
  std::vector<Mark> marks_;  // by vertex
  std::vector<Met> met_;
  std::vector<std::array<std::uint32_t, 4>> last_records_;  // as met_, by heading
  std::vector<Record> records_;
  std::vector<std::vector<Item>> levels_;  // by turns, with those that are left at the least
};

}  // namespace split_mapf
