#pragma once

#include <cstdint>
#include <vector>

#include "solver/search/bucket_queue.h"
#include "solver/search/gap_search.h"
#include "solver/search/path_table.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/graph.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// A question that may be answered by a path that meets placed robots.
struct EvictionQuery : GapQuery {
  /// What it costs to evict a robot, by robot, each at least 1; null: nobody may be evicted.
  const std::vector<std::uint32_t>* weights = nullptr;
};

/// Finds the path that runs into placed robots of the least total weight and, among such paths, the
/// one that arrives first.
/// Most paths evict nobody, so a GapSearch asks for these first. Only when there are none do the
/// visits count: who could be evicted from what the GapSearch reached is where this search begins.
/// A state is a vertex and the number of a gap or visit. A robot that is met again after others in
/// between is counted again, so the weight may be over-estimated.
/// Keeps its memory between calls; not thread-safe. Memory: two entries a visit of the vertices
/// that the search meets.
class EvictionSearch {
 public:
  explicit EvictionSearch(const Graph& graph);
  GapAnswer search(const EvictionQuery& query, const Deadline& deadline);

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
  struct Waiting {
    std::uint32_t weight;
    std::uint32_t estimate;
    std::uint32_t index;
  };
  static bool comesLater(const Waiting& a, const Waiting& b);

  void reset();
  void prepareGoal();
  bool pushStart();
  void leaveGaps();
  Seen& seen(Vertex v, std::uint32_t span);
  void expand(std::uint32_t index, bool only_evicting);
  void wait(const State& state, std::uint32_t index);
  void move(const State& state, std::uint32_t index, Vertex to, std::uint32_t leave_by);
  void moveEvicting(const State& state, std::uint32_t index, Vertex to, std::uint32_t leave_by);
  void enter(const State& state, std::uint32_t index, Vertex to, std::uint32_t span,
             std::uint32_t first, std::uint32_t last);
  void reach(std::uint32_t parent, Vertex to, std::uint32_t span, std::uint32_t time,
             std::uint32_t weight);
  void arrive(const State& state, std::uint32_t parent);
  std::uint32_t swapWeight(Vertex from, Vertex to, std::uint32_t span, std::uint32_t time) const;
  std::uint32_t weightToEnter(const State& state, Vertex to, std::uint32_t span) const;
  void push(const State& state, std::uint32_t estimate);
  std::uint32_t pop();
  bool openNextWeight();

  // Span 2k of a vertex is the gap before visit k, span 2k + 1 visit k itself.
  static bool isVisit(std::uint32_t span) { return span % 2 == 1; }
  std::uint32_t endOf(Vertex v, std::uint32_t span) const;
  std::uint32_t weightOf(const Stay& stay) const { return (*query_->weights)[stay.robot]; }

  const Graph& graph_;
  const EvictionQuery* query_ = nullptr;
  GapSearch gaps_;

  // Spans of the vertices that this search has met.
  std::vector<std::uint32_t> met_;  // number of the search that met the vertex last
  std::vector<std::uint32_t> first_span_;
  std::vector<Seen> seen_;
  std::uint32_t search_number_ = 0;

  std::vector<std::uint32_t> weight_from_visit_;  // of the visits to the goal from each on

  // Most weights are small: states of the least weight are in the queue, over arrival, the others
  // wait in a list a weight until it is their turn, and very heavy ones in a heap.
  static constexpr std::uint32_t kLists = 128;
  BucketQueue<State> queue_;
  std::uint32_t open_weight_ = 0;
  std::vector<std::vector<Waiting>> waiting_;
  std::vector<Waiting> heap_;
};

}  // namespace split_mapf
