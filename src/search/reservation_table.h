#pragma once

#include <cstdint>
#include <vector>

#include "search/path_table.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/reservations.h"

namespace split_mapf {

/// The paths of robots that do not conflict: the visits of each vertex, and one bit for each vertex
/// and step that says whether somebody is there. A search asks for 64 steps at a time.
/// Memory: the path table, and vertices x greatest arrival / 8 bytes. Not thread-safe; const
/// members are.
/// With a headway of a step nobody comes to a vertex in the step in which another leaves it, as
/// robots cannot that wait for a part of that move: no paths of the table do, and none that is
/// searched for. So robots cannot rotate either.
class ReservationTable {
 public:
  /// @param headway  0 or 1 [steps]
  explicit ReservationTable(std::uint32_t vertices, std::uint32_t headway = 0);
  /// Of robots 0, 1, ... @pre the plan has no conflicts, and keeps the headway; its paths end at
  /// their arrivals.
  ReservationTable(std::uint32_t vertices, const Plan& plan, std::uint32_t headway = 0);

  /// @pre the robot has no path in the table, and no other is where this one is; the path ends at
  /// its arrival.
  void insert(std::uint32_t robot, const Path& path);
  /// @pre `path` is what was inserted for the robot.
  void remove(std::uint32_t robot, const Path& path);
  /// As PathTable's: at step `from` the robot stays where it is, what comes later is removed.
  void removeTail(std::uint32_t robot, const Path& path, std::uint32_t from);
  void insertTail(std::uint32_t robot, const Path& path, std::uint32_t from);
  void removeHead(std::uint32_t robot, const Path& path, std::uint32_t from);

  /// Gives the robot the other path, where no robot is in its way; `own` and `path` then change
  /// places. @return whether it has it. @pre `own` is what was inserted for the robot.
  bool exchange(std::uint32_t robot, Path& own, Path& path);

  /// Closes a vertex for one step at which nobody is there, or opens it again: no path of the
  /// table, but none that is searched for leads there. @pre t is no later than lastChange().
  void toggleStep(Vertex v, std::uint32_t t) {
    if (headway() > 0) return toggleHeld(v, t);
    bits_[std::size_t{v} * words_ + t / 64] ^= std::uint64_t{1} << (t % 64);
  }

  /// Hides from a robot whose tail is removed that it holds the vertex of step `from` for the
  /// headway, which keeps others away but not itself; a second call undoes it.
  void toggleHeadway(const Path& path, std::uint32_t from) {
    if (headway() > 0) toggleStep(positionAt(path, from), from + 1);
  }

  std::uint32_t headway() const { return paths_.headway(); }
  const PathTable& paths() const { return paths_; }
  /// As PathTable's.
  std::uint64_t changes() const { return paths_.changes(); }
  const std::vector<Stay>& at(Vertex v) const { return paths_.at(v); }
  /// Bit i: who is at `v` at step 64 * word + i is in the way of somebody, or in somebody's. Any
  /// word may be asked for.
  std::uint64_t taken(Vertex v, std::uint32_t word) const { return wordOf(bits_, v, word); }

  /// Has the word loaded that taken() will be asked for soon.
  void prefetch(Vertex v, std::uint32_t word) const {
    if (word < words_) __builtin_prefetch(bits_.data() + std::size_t{v} * words_ + word);
  }
  bool isTaken(Vertex v, std::uint32_t t) const { return (taken(v, t / 64) >> (t % 64) & 1U) != 0; }
  /// The first step after `t` at which somebody is at `v`; last + 1 if nobody is until step `last`.
  std::uint32_t takenAfter(Vertex v, std::uint32_t t, std::uint32_t last) const;
  /// The step from which on nobody held `v` until step t - 1; `t` if somebody did then.
  std::uint32_t freeSince(Vertex v, std::uint32_t t) const;
  /// Whether nobody is in the way of a robot that stays on the path after step `from`, and at its
  /// end for good. @pre of the robot's own visits none is known that begins later than `from`.
  bool isFree(const Path& path, std::uint32_t from) const;
  /// The visit to `to` of a robot that goes from there to `from` at the very step `t` at which the
  /// robot that asks would go the other way; null if nobody does. @pre t > 0.
  const Stay* oncoming(Vertex from, Vertex to, std::uint32_t t) const;
  /// A step after which nobody moves any more.
  std::uint32_t lastChange() const { return 64 * words_ - 1; }

 private:
  // After the last step of the bits nothing changes any more.
  static std::uint64_t everAfter(std::uint64_t last_word) { return 0 - (last_word >> 63U); }
  std::uint64_t wordOf(const std::vector<std::uint64_t>& bits, Vertex v, std::uint32_t word) const {
    const std::uint64_t* const row = bits.data() + std::size_t{v} * words_;
    return word < words_ ? row[word] : everAfter(row[words_ - 1]);
  }
  std::uint64_t heldSteps(Vertex v, std::uint32_t word) const {
    return wordOf(headway() > 0 ? held_ : bits_, v, word);
  }
  void toggleHeld(Vertex v, std::uint32_t t);
  void showHeld(Vertex v, std::uint32_t word);
  void coverSteps(std::size_t steps);
  void hold(Vertex v, std::uint32_t begin, std::uint32_t end);
  void flip(const Path& path, std::uint32_t from);
  void flipSteps(const Path& path, std::uint32_t from, std::uint32_t to);

  PathTable paths_;
  std::uint32_t words_ = 1;  // of a vertex
  std::vector<std::uint64_t> bits_;
  std::vector<std::uint64_t> held_;  // of these who is there or has just left; with a headway only
};

/// Of a plan, and behind its robots of the paths that are reserved; null: none.
ReservationTable tableOf(std::uint32_t vertices, const Plan& plan, const Reservations* reserved,
                         std::uint32_t headway);

}  // namespace split_mapf
