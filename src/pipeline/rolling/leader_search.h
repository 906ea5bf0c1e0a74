#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <queue>
#include <set>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "pipeline/rolling/slopes.h"

namespace split_mapf::rolling {

/// What a search for a leader's way may rely on.
struct LeaderQuestion {
  const MoveGraph* graph = nullptr;
  const std::vector<bool>* inside = nullptr;    ///< by vertex: where robots may be moved
  const std::vector<bool>* occupied = nullptr;  ///< by vertex: a robot stands there, or the leader
  Vertex leader = kNoVertex;
  const Slope* slope = nullptr;  ///< to the leader's goal
  std::uint32_t left = 0;        ///< steps to its goal
  std::uint32_t aim = 0;         ///< less than `left`: how many may be left in the end
  std::uint64_t visits = 0;      ///< of vertices, about, behind which it gives up
};

/// One robot's move by one edge: of whoever is at `from` by then.
struct LeaderMove {
  Vertex from;
  Vertex to;
};

/// Brings one robot nearer to its goal through a crowd whose robots may end anywhere. All that
/// matters of them is how many vertices are free on each side of the leader: it gets to the next
/// vertex where one is free on that side, as those in between make room one after the other. Where
/// none is, it has to back off until robots can pass it. So a state is the leader's vertex and the
/// number of free vertices in each part that it cuts off from the others; best-first by moves of
/// the leader and steps in which a part behind it is emptied, not those of what steps aside.
/// Source: the problem is that of Papadimitriou et al., "Motion planning on a graph" (FOCS 1994);
/// the search is ours. Not thread-safe.
class LeaderSearch {
 public:
  /// @pre the leader is inside; what the question points to outlives this object.
  explicit LeaderSearch(const LeaderQuestion& question);

  /// Moves in an order in which the end of each is free; the last one is the leader's. Call it
  /// once.
  /// @return nothing when there are none, or the visits are over. Cost: O(vertices inside) a state.
  std::optional<std::vector<LeaderMove>> find();
  std::uint64_t visits() const { return visits_; }

 private:
  using Number = std::uint32_t;  // of a vertex inside
  using Part = std::uint8_t;     // of what is left without a vertex
  struct State {
    Number leader = 0;
    std::uint32_t left = 0;
    std::uint32_t cost = 0;
    std::uint32_t parent = kNone;
    std::vector<LeaderMove> moves;  // since the parent
    std::vector<bool> occupied;     // by number
  };
  static constexpr std::uint32_t kNone = 0xffffffffU;
  static constexpr Part kNoPart = 0xffU;

  void expand(std::uint32_t index);
  void makeRoom(std::uint32_t index, Slot slot, Part part);
  bool makeRoomOnce(State& state, Number to, Part part);
  void arrive(State state, std::uint32_t parent, Slot slot, Part kept);
  void add(State state);
  std::vector<LeaderMove> movesTo(std::uint32_t index) const;
  const std::vector<Part>& partsWithout(Number number);
  template <typename Inside, typename End>
  std::vector<Number> wayTo(Number from, const Inside& inside, const End& is_end);
  std::uint32_t shift(const std::vector<Number>& way, State& state) const;

  const LeaderQuestion& question_;
  std::vector<Vertex> vertices_;                  // by number
  std::vector<std::array<Number, kSlots>> next_;  // by number and slot, kNone: none inside
  std::unordered_map<Number, std::vector<Part>> parts_;
  std::vector<State> states_;
  std::set<std::vector<std::uint32_t>> known_;
  using Entry = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;  // cost, left, state
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open_;
  std::vector<Number> before_;  // of a way, kNone where it has not been
  std::uint64_t visits_ = 0;
};

}  // namespace split_mapf::rolling
