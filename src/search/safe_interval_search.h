#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "search/bucket_queue.h"
#include "search/constraints.h"
#include "search/path_table.h"
#include "search/timeline.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/distance_table.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// What the other robots' paths mean to a search.
enum class OthersAre {
  kIgnored,  ///< they are not there
  kCounted,  ///< running into them is allowed and counted
};

/// One robot's question.
struct SearchQuery {
  std::uint32_t robot = 0;
  Vertex start = kNoVertex;
  const DistanceTable* distances = nullptr;  ///< to the goal
  const PathTable* others = nullptr;         ///< may hold the robot itself; it is skipped
  OthersAre mode = OthersAre::kIgnored;
  const RobotConstraints* constraints = nullptr;  ///< may be null
  const PathTable* reserved = nullptr;  ///< paths to keep clear of, whatever the mode; may be null
  std::uint32_t latest_arrival = kForever - 1;  ///< longest path allowed [steps]
  /// With kCounted an arrival after `cheap_arrival` weighs like one collision for every
  /// `steps_a_collision` steps, after `firm_arrival` like several for each step.
  std::uint32_t cheap_arrival = kForever;
  std::uint32_t steps_a_collision = 1;
  std::uint32_t firm_arrival = kForever;
};

/// The answer; `path` is empty when there is none (or when the deadline came: `interrupted`).
struct SearchAnswer {
  Path path;
  bool interrupted = false;
  std::uint64_t expansions = 0;
};

/// Single-robot search on (vertex, safe interval) states. Finds the path with the fewest
/// collisions with the others, and among these the earliest arrival, that obeys the constraints and
/// arrives in time; with others ignored it is the earliest arrival. Where they must be kept clear
/// of, GapSearch is the faster one. Sources: Phillips and Likhachev, ICRA 2011 (safe intervals); Li
/// et al., AAAI 2022 (soft obstacles cut intervals too). Deviations: a bucket queue instead of
/// heaps; the intervals of a vertex are kept by the path table between searches; a state first
/// makes the moves that end at the next step and queues one continuation for all later ones, as
/// most are never needed; the goal's waiting time inside the heuristic. Keeps its memory between
/// calls; not thread-safe.
class SafeIntervalSearch {
 public:
  explicit SafeIntervalSearch(const Graph& graph);
  SearchAnswer search(const SearchQuery& query, const Deadline& deadline);

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  enum class Kind : std::uint16_t {
    kVisit,    ///< enters a segment of the vertex at `time`
    kArrival,  ///< enters the goal at `time` for good
    kLater,    ///< the moves of its parent that end at `time` or later
  };
  struct State {
    std::uint32_t place;  // of the segment among those met
    Vertex vertex;
    std::uint32_t time;
    std::uint32_t parent;
    std::uint32_t next = kNone;  // in its bucket
    std::uint16_t conflicts;
    Kind kind;
  };
  struct Best {  // what was seen of a segment
    std::uint32_t closed_time = kNone;
    std::uint32_t pushed_time = kNone;
    std::uint32_t pushed_conflicts = kNone;
  };
  struct Meeting {  // of a vertex with a search
    std::uint32_t search = 0;
    std::uint32_t first_place = 0;
    std::uint32_t count = 0;
    const Segment* segments = nullptr;
  };

  bool prepareGoal();
  bool pushStart();
  const Meeting& meet(Vertex v);
  const Timeline& timelineOf(Vertex v);
  Timeline& ownTimeline();
  /// The timeline without the steps of reserved visits, or itself.
  const Timeline& withoutReserved(Vertex v, const Timeline& timeline);
  std::uint32_t distanceOf(Vertex v) const {
    if (flat_ == nullptr) return (*query_->distances)(v);
    return flat_[v] != 0xffffU ? flat_[v] : DistanceTable::kUnreachable;
  }
  bool close(const State& state);
  void expand(std::uint32_t index);
  void expandWait(const State& state, const Segment& segment, std::uint32_t index);
  /// The moves of a state that end at step `from` exactly, and those of the next step also into
  /// segments that have begun before.
  void expandMoves(const State& state, std::uint32_t index, std::uint32_t from);
  void enter(const State& state, std::uint32_t index, Vertex to, std::uint32_t number,
             std::uint32_t time);
  void arrive(const State& state, std::uint32_t index, std::uint32_t number, std::uint32_t time,
              std::uint32_t last);
  bool isMoveBanned(Vertex from, Vertex to, std::uint32_t step) const;
  bool firstAllowed(Vertex from, Vertex to, std::uint32_t& time, std::uint32_t last) const;
  std::uint32_t swaps(const State& state, Vertex to, const Segment& there,
                      std::uint32_t time) const;
  std::uint32_t weightOf(std::uint32_t conflicts, std::uint32_t estimate) const;
  void push(const State& state, std::uint32_t estimate);
  void pushVisit(const State& state, std::uint32_t distance);
  void pushLater(const State& state, std::uint32_t index, std::uint32_t time);
  std::uint32_t estimateOf(std::uint32_t time, std::uint32_t distance) const;
  void reset();

  const Graph& graph_;
  TimelineBuilder builder_;
  const SearchQuery* query_ = nullptr;
  const std::uint16_t* flat_ = nullptr;  // the distances, where they lie in one array

  // What this search has met: segments of vertices, and what it knows of each.
  std::vector<Meeting> met_;
  std::vector<Best> best_;
  std::uint32_t search_number_ = 0;
  // Timelines that differ from the table's: without the robot itself, or cut by constraints.
  std::deque<Timeline> own_timelines_;
  std::size_t own_count_ = 0;

  // Goal: from this step on it can be held for good; collisions still to come from each segment.
  std::uint32_t earliest_hold_ = 0;
  std::vector<std::uint32_t> collisions_after_;

  // Open states by (weight, estimate).
  BucketQueue<State> queue_;
  std::uint32_t first_estimate_ = 0;
  std::uint32_t estimates_ = 0;  // keys a row; 0: a single row
};

}  // namespace split_mapf
