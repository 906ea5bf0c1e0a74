#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "search/bucket_queue.h"
#include "search/reached_steps.h"
#include "search/reservation_table.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/distance_table.h"
#include "split_mapf/core/graph.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// When a search stops looking for the path that arrives first, in expansions, and when it gives
/// up. Never, unless said otherwise.
struct Hurry {
  static constexpr std::uint64_t kNever = ~std::uint64_t{0};

  /// From so many on a path is wanted soon: what is left of the way counts then, and a step of
  /// delay as much as kStepsADelay steps of it (weighted A*, Pohl 1970).
  std::uint64_t begin = kNever;
  static constexpr std::uint32_t kStepsADelay = 8;
  /// From so many on as much as fewer steps: whoever is delayed more than once in kStepsADelay
  /// steps would go back to the start of its way again and again. An EvictionSearch, which comes
  /// later, does so at once.
  std::uint64_t greedy = kNever;
  static constexpr std::uint32_t kGreedyStepsADelay = 2;
  /// After so many a GapSearch has no answer, which does not mean that there is no path, and an
  /// EvictionSearch goes on to the next weight; `hasty` is of no effect then.
  std::uint64_t end = kNever;
};

/// The estimate of the way that is left that a query asks for.
class WayLeft {
 public:
  void ask(const DistanceTable& distances, const Grid* rows_and_columns) {
    distances_ = &distances;
    narrow_ = distances.narrowEntries();
    grid_ = rows_and_columns;
    if (grid_ != nullptr) goal_ = grid_->cellOf(distances.goal());
  }
  std::uint32_t operator()(Vertex v) const {
    // First: what a table happens to know must not change the plan.
    if (grid_ != nullptr) return rowsAndColumns(grid_->cellOf(v), goal_);
    return narrow_ != nullptr ? narrow_[v] : (*distances_)(v);
  }

 private:
  const DistanceTable* distances_ = nullptr;
  const std::uint16_t* narrow_ = nullptr;  // the distances, where they have this form
  const Grid* grid_ = nullptr;             // null: the table is read
  Cell goal_ = {};
};

/// One robot's question among robots that have paths without conflicts.
struct GapQuery {
  Vertex start = kNoVertex;
  const DistanceTable* distances = nullptr;  ///< to the goal
  const ReservationTable* placed = nullptr;  ///< @pre without the robot that asks, see under_way
  std::uint32_t departure = 0;               ///< stays at its start until this step
  /// Whether `placed` knows that the robot is at its start at step `departure`, and nothing else of
  /// what it does then or later: it is on its way already, and this is where it may change it.
  bool under_way = false;
  std::uint32_t latest_arrival = kForever - 1;  ///< longest path allowed [steps]
  Hurry hurry;
  /// Rows and columns to the goal stand in for distances where this is given, so that no table is
  /// read: where they say nearly the same. @pre its graph is the search's, each move of it crosses
  /// one row or column, and there is a way from the start.
  const Grid* rows_and_columns = nullptr;
};

/// The question of a robot that keeps its path until step `kept`.
inline GapQuery queryFrom(const Path& path, std::uint32_t kept, const DistanceTable& distances,
                          const ReservationTable& placed, std::uint32_t latest_arrival) {
  GapQuery query;
  query.start = path[kept];
  query.distances = &distances;
  query.placed = &placed;
  query.departure = kept;
  query.under_way = true;
  query.latest_arrival = latest_arrival;
  return query;
}

/// What searches did, and how long that takes, counted in states. A state takes longer where it has
/// more neighbours, and where more of these were not reached yet.
struct SearchWork {
  static constexpr std::uint64_t kTenthsALook = 1;   ///< of a state, at a neighbour
  static constexpr std::uint64_t kTenthsAPlace = 5;  ///< for a vertex and step that was reached
  static constexpr std::uint64_t kTenthsAnEviction = 10;  ///< the same if robots may be evicted

  std::uint64_t expansions = 0;
  std::uint64_t tenths = 0;  ///< of an ordinary state, that they took as long as

  std::uint64_t states() const { return tenths / 10; }
  SearchWork& operator+=(const SearchWork& other) {
    expansions += other.expansions;
    tenths += other.tenths;
    return *this;
  }
};

/// The answer; `path` is empty when there is none, when the deadline came (`interrupted`) or when
/// none was found before the end of its hurry (`cut_short`).
struct GapAnswer {
  Path path;
  bool interrupted = false;
  bool cut_short = false;
  SearchWork work;
};

/// Finds the path among placed robots that arrives first, holding the goal for good.
/// Safe intervals as in SafeIntervalSearch, but as the placed robots have no conflicts, the gaps
/// between the visits to a vertex are all there is: a state is a vertex and a step, and stands for
/// the rest of the gap around it. What was reached is one bit a vertex and step, so that 64 steps
/// of a neighbour are looked at in one go: free, and not reached yet.
/// Keeps its memory between calls; not thread-safe. Memory: one bit for each step of the vertices
/// that the search meets.
class GapSearch {
 public:
  static constexpr std::uint32_t kNoState = 0xffffffffU;

  struct State {
    Vertex vertex;
    std::uint32_t time;      // of the first step there
    std::uint32_t leave_by;  // the next robot comes at this step; kForever: none, or too late
    std::uint32_t parent;
    std::uint32_t next = kNoState;  // in its bucket
  };

  explicit GapSearch(const Graph& graph);
  GapAnswer search(const GapQuery& query, const Deadline& deadline);

  /// What the last search came upon, in no order.
  const std::vector<State>& states() const { return queue_.states(); }
  /// Where and when the last search could be: all of it from which one could still arrive in time,
  /// once there was no path. Another search may go on with it.
  ReachedSteps& reached() { return reached_; }
  /// No search for that query goes beyond this step.
  std::uint32_t latestArrival() const { return latest_arrival_; }
  /// Whether the state's gap was reached earlier, too.
  bool isOutdated(const State& state) const {
    return state.time > 0 && reached_(state.vertex, state.time - 1);
  }

 private:
  bool begin();
  void findArrival(GapAnswer& answer, const Deadline& deadline);
  bool isStartFree() const;
  void hurry(std::uint32_t steps_a_delay);
  void expand(std::uint32_t index);
  void move(const State& state, std::uint32_t index, Vertex to);
  void push(std::uint32_t parent, Vertex v, std::uint32_t time, std::uint32_t distance);
  std::uint32_t distanceOf(Vertex v) const { return way_left_(v); }
  /// What comes first: of the estimated arrivals the earliest, or what looks soon done.
  std::size_t keyOf(std::uint32_t estimate, std::uint32_t distance) const {
    if (steps_a_delay_ == 0) return estimate - first_estimate_;
    // Until the goal can be held a delay costs nothing.
    const std::uint32_t least = std::max(first_estimate_, earliest_hold_);
    const std::size_t delay = estimate - std::min(estimate, least);
    return delay * steps_a_delay_ + distance;
  }

  const Graph& graph_;
  const GapQuery* query_ = nullptr;
  WayLeft way_left_;
  std::uint32_t latest_arrival_ = 0;
  std::uint32_t earliest_hold_ = 0;  // from this step on the goal can be held for good
  std::uint32_t steps_a_delay_ = 0;  // 0: it does not hurry
  std::uint32_t first_estimate_ = 0;
  std::uint32_t estimate_ = 0;        // of the state that is expanded
  std::uint32_t arrived_ = kNoState;  // a state that holds the goal as soon as any can
  std::uint64_t looks_ = 0;           // at neighbours
  ReachedSteps reached_;
  BucketQueue<State> queue_;  // over arrival
};

}  // namespace split_mapf
