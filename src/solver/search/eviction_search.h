#pragma once

#include <cstdint>
#include <vector>

#include "solver/search/bucket_queue.h"
#include "solver/search/path_table.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/distance_table.h"
#include "split_mapf/core/graph.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// One robot's question among robots that have paths without conflicts.
struct EvictionQuery {
  Vertex start = kNoVertex;
  const DistanceTable* distances = nullptr;  ///< to the goal
  /// The placed robots. @pre no two of them conflict; the robot that asks is not among them.
  const PathTable* placed = nullptr;
  /// What it costs to evict a robot, by robot, each at least 1; null: nobody may be evicted.
  const std::vector<std::uint32_t>* weights = nullptr;
  std::uint32_t departure = 0;                  ///< stays at its start until this step
  std::uint32_t latest_arrival = kForever - 1;  ///< longest path allowed [steps]
};

/// The answer; `path` is empty when there is none (or when the deadline came: `interrupted`).
struct EvictionAnswer {
  Path path;
  bool interrupted = false;
  std::uint64_t expansions = 0;
};

/// Finds the path that runs into placed robots of the least total weight and, among such paths, the
/// one that arrives first; where nobody may be evicted simply the first to arrive.
/// Safe intervals as in SafeIntervalSearch, but the placed robots have no conflicts, so at each
/// vertex visits and gaps alternate, and no timeline has to be built: a state is a vertex and the
/// number of a gap or visit. Paths that evict nobody come from buckets over arrival; all others
/// wait in a heap. A robot that is met again after others in between is counted again, so the
/// weight may be over-estimated.
/// Keeps its memory between calls; not thread-safe. Memory: two entries a visit of the vertices
/// that the search meets.
class EvictionSearch {
 public:
  explicit EvictionSearch(const Graph& graph);
  EvictionAnswer search(const EvictionQuery& query, const Deadline& deadline);

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  struct State {
    Vertex vertex;
    std::uint32_t span;  // of the vertex; kNone once the robot stays at its goal
    std::uint32_t time;
    std::uint32_t weight;
    std::uint32_t parent;
    std::uint32_t next = kNone;  // in its bucket
  };
  struct Seen {  // what was seen of a span
    std::uint32_t closed_time = kNone;
    std::uint32_t pushed_time = kNone;
    std::uint32_t pushed_weight = kNone;
  };
  struct Waiting {  // in the heap
    std::uint32_t weight;
    std::uint32_t estimate;
    std::uint32_t index;
  };
  static bool comesLater(const Waiting& a, const Waiting& b);

  bool prepareGoal();
  bool pushStart();
  Seen& seen(Vertex v, std::uint32_t span);
  void expand(std::uint32_t index);
  void wait(const State& state, std::uint32_t index);
  void move(const State& state, std::uint32_t index, Vertex to, std::uint32_t leave_by);
  void enter(const State& state, std::uint32_t index, Vertex to, std::uint32_t span,
             std::uint32_t first, std::uint32_t last);
  void reach(std::uint32_t parent, Vertex to, std::uint32_t span, std::uint32_t time,
             std::uint32_t weight);
  std::uint32_t swapWeight(Vertex from, Vertex to, std::uint32_t span, std::uint32_t time,
                           bool& swaps) const;
  std::uint32_t weightToEnter(const State& state, Vertex to, std::uint32_t span) const;
  void push(const State& state, std::uint32_t estimate);
  std::uint32_t pop();
  void reset();

  // Span 2k of a vertex is the gap before visit k, span 2k + 1 visit k itself.
  static bool isVisit(std::uint32_t span) { return span % 2 == 1; }
  std::uint32_t beginOf(Vertex v, std::uint32_t span) const;
  std::uint32_t endOf(Vertex v, std::uint32_t span) const;
  std::uint32_t weightOf(const Stay& stay) const { return (*query_->weights)[stay.robot]; }

  const Graph& graph_;
  const EvictionQuery* query_ = nullptr;

  // Spans of the vertices that this search has met.
  std::vector<std::uint32_t> met_;  // number of the search that met the vertex last
  std::vector<std::uint32_t> first_span_;
  std::vector<Seen> seen_;
  std::uint32_t search_number_ = 0;

  // Goal: from this step on it can be held for good; the weight of the visits from each on.
  std::uint32_t earliest_hold_ = 0;
  std::vector<std::uint32_t> weight_from_visit_;

  BucketQueue<State> queue_;  // over arrival; open there: weight 0 only
  std::uint32_t first_estimate_ = 0;
  std::vector<Waiting> heap_;  // weight above 0
};

/// The placed robots that a path conflicts with: at a vertex, by a swap, or because one holds its
/// goal for good. Each once, in ascending order. Cost: O(visits to the path's vertices).
std::vector<std::uint32_t> robotsInTheWay(const PathTable& placed, const Path& path);

}  // namespace split_mapf
