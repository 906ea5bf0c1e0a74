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
/// A state is a vertex and a step and stands for the rest of the gap or visit around it; as weights
/// come in ascending order, a bit a step says what was reached, and for visits what was offered. A
/// robot that is met again after others in between is counted again, so the weight may be
/// over-estimated.
/// Keeps its memory between calls; not thread-safe. Memory: two bits for each step of the vertices
/// that the search meets.
class EvictionSearch {
 public:
  explicit EvictionSearch(const Graph& graph);
  GapAnswer search(const EvictionQuery& query, const Deadline& deadline);

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;
  static constexpr std::uint32_t kArrived = 0xfffffffeU;

  struct State {
    Vertex vertex;
    std::uint32_t time;   // of the first step there
    std::uint32_t end;    // the next visit, or the end of this one
    std::uint32_t robot;  // whose visit it is; kNone: a gap; kArrived: stays at the goal for good
    std::uint32_t parent;
    std::uint32_t next = kNone;  // in its bucket
  };
  struct Waiting {
    std::uint32_t weight;
    std::uint32_t index;
  };
  static bool comesLater(const Waiting& a, const Waiting& b);

  void reset();
  bool pushStart();
  void leaveGaps();
  std::uint32_t pop();
  bool openNextWeight();
  void open(std::uint32_t index);
  void expand(std::uint32_t index);
  void evictFrom(const State& state, std::uint32_t index);
  void arrive(const State& state, std::uint32_t index);
  void wait(const State& state, std::uint32_t index);
  void moveIntoGaps(const State& state, std::uint32_t index, Vertex to);
  void moveIntoVisits(const State& state, std::uint32_t index, Vertex to);
  void moveAtLast(const State& state, std::uint32_t index, Vertex to);
  void enterVisit(const State& state, const Stay& visit, const State& entered);
  void push(const State& state, std::uint32_t weight);
  bool inTime(Vertex v, std::uint32_t t) const;
  const Stay* nextVisit(Vertex v, std::uint32_t t) const;
  std::uint32_t weightOf(const Stay& stay) const { return (*query_->weights)[stay.robot]; }

  const Graph& graph_;
  const EvictionQuery* query_ = nullptr;
  GapSearch gaps_;
  ReachedSteps offered_;  // of visits: somebody waits who enters them then, or did
  std::uint32_t latest_arrival_ = 0;

  // States of the least weight are in the queue, over arrival; the others wait for their turn, in a
  // list a weight, as most weights are small, or in a heap.
  static constexpr std::uint32_t kLists = 128;
  BucketQueue<State> queue_;
  std::uint32_t weight_ = 0;  // of what is open
  std::vector<std::vector<std::uint32_t>> waiting_;
  std::vector<Waiting> heap_;
};

}  // namespace split_mapf
