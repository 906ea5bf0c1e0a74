#pragma once

#include <cstdint>
#include <vector>

#include "solver/search/timeline.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/distance_table.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// One robot's question.
struct SearchQuery {
  std::uint32_t robot = 0;
  Vertex start = kNoVertex;
  const DistanceTable* distances = nullptr;  ///< to the goal
  const PathTable* others = nullptr;         ///< may hold the robot itself; it is skipped
  OthersAre mode = OthersAre::kIgnored;
  const RobotConstraints* constraints = nullptr;  ///< may be null
  std::uint32_t latest_arrival = kForever - 1;    ///< longest path allowed [steps]
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
/// arrives in time; with others ignored or as obstacles it is the earliest arrival.
/// Sources: Phillips and Likhachev, ICRA 2011 (safe intervals); Li et al., AAAI 2022 (soft
/// obstacles cut intervals too). Deviations: a bucket queue instead of heaps, intervals built
/// lazily a search, the goal's waiting time inside the heuristic.
/// Keeps its memory between calls; not thread-safe.
class SafeIntervalSearch {
 public:
  explicit SafeIntervalSearch(const Graph& graph);
  SearchAnswer search(const SearchQuery& query, const Deadline& deadline);

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  struct State {
    std::uint32_t segment;  // index into segments_; kNone for an arrival at the goal for good
    Vertex vertex;
    std::uint32_t time;
    std::uint32_t parent;
    std::uint32_t conflicts;
    std::uint32_t next;  // in its bucket
  };
  struct Best {  // what was seen of a segment
    std::uint32_t closed_time = kNone;
    std::uint32_t pushed_time = kNone;
    std::uint32_t pushed_conflicts = kNone;
  };
  struct Window {  // of the steps at which a move may end
    std::uint32_t first;
    std::uint32_t last;
  };

  bool prepareGoal();
  bool pushStart();
  std::uint32_t segmentsOf(Vertex v, std::uint32_t& count);
  void expand(std::uint32_t index);
  void expandWait(const State& state, std::uint32_t index);
  void expandMoves(const State& state, std::uint32_t index, Vertex to);
  void tryEnter(const State& state, std::uint32_t index, Vertex to, std::uint32_t segment,
                Window window);
  void tryArrive(const State& state, std::uint32_t index, std::uint32_t segment, Window window);
  bool firstAllowed(Vertex from, Vertex to, Window window, std::uint32_t& time) const;
  std::uint32_t swaps(Vertex from, Vertex to, std::uint32_t time) const;
  std::uint32_t weightOf(std::uint32_t conflicts, std::uint32_t estimate) const;
  void push(const State& state, std::uint32_t estimate);
  void pushToSegment(const State& state, std::uint32_t distance);
  std::uint32_t pop();
  std::uint32_t estimateOf(std::uint32_t time, std::uint32_t distance) const;
  void reset();
  Path reconstruct(std::uint32_t index) const;

  const Graph& graph_;
  TimelineBuilder builder_;
  const SearchQuery* query_ = nullptr;

  // Segments of the vertices that this search has met.
  std::vector<std::uint32_t> met_;  // number of the search that met the vertex last
  std::vector<std::uint32_t> first_segment_;
  std::vector<std::uint32_t> segment_count_;
  std::vector<Segment> segments_;
  std::vector<Best> best_;
  std::uint32_t search_number_ = 0;

  // Goal: from this step on it can be held for good; collisions still to come from each segment.
  std::uint32_t earliest_hold_ = 0;
  std::uint32_t goal_first_segment_ = 0;
  std::vector<std::uint32_t> collisions_after_;

  // Bucket queue over (weight, estimate), last in first out.
  std::vector<State> states_;
  std::vector<std::uint32_t> buckets_;
  std::uint32_t first_estimate_ = 0;
  std::uint32_t estimates_ = 0;  // buckets a row; 0: a single row
  std::size_t current_bucket_ = 0;
  std::size_t last_bucket_ = 0;
  std::size_t queued_ = 0;
};

}  // namespace split_mapf
