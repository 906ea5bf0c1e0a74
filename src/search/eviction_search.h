#pragma once

#include <cstdint>
#include <vector>

#include "search/bucket_queue.h"
#include "search/gap_search.h"
#include "search/path_table.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/graph.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// A question that may be answered by a path that meets placed robots.
struct EvictionQuery : GapQuery {
  static constexpr std::uint32_t kFixed = 0xffffffffU;  ///< weight of who may not be evicted
  /// What it costs to evict a robot, by robot, each at least 1; null: nobody may be evicted.
  const std::vector<std::uint32_t>* weights = nullptr;
  /// Whether a path that evicts may arrive later than another of its weight, as long as it is in
  /// time: it is found with about six tenths of the effort where robots crowd.
  bool hasty = false;
};

/// Finds the path that runs into placed robots of the least total weight and, among such paths, the
/// one that arrives first, or in haste one that is found soon (weighted A*, Pohl 1970). In a hurry
/// that ends neither is sure: it is one that was found soon.
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
    std::uint32_t time;  // of the first step there
    std::uint32_t end;   // the next visit, or the end of this one
    // Where the robot whose visit it is moves at `end`; kNone: it is a gap, or the robot does not
    // leave; kArrived: stays at the goal for good.
    Vertex towards;
    std::uint32_t parent;
    std::uint32_t next = kNone;  // in its bucket
  };
  struct Waiting {
    std::uint32_t weight;
    std::uint32_t index;
  };
  static bool comesLater(const Waiting& a, const Waiting& b);

  void findArrival(GapAnswer& answer, const Deadline& deadline);
  void reset();
  bool pushStart();
  void leaveGaps();
  bool hasTurn();
  bool isEvictionsTurn();
  std::uint32_t leaveWeight();
  void sortTurn();
  bool openNextWeight();
  void openWaiting();
  void open(std::uint32_t index);
  void expand(std::uint32_t index);
  void evictFrom(std::uint32_t index);
  void arrive(const State& state);
  void leaveVisit(const State& state, std::uint32_t index);
  void waitIntoVisit(const State& state, std::uint32_t index);
  void moveIntoGaps(const State& state, std::uint32_t index, Vertex to);
  void moveIntoVisits(const State& state, std::uint32_t index, Vertex to);
  void evictOncoming(const State& state, std::uint32_t index, Vertex to);
  bool enterVisit(const State& state, const Stay& visit, const State& entered);
  void push(const State& state, std::uint32_t weight);
  bool isOutdated(const State& state);
  bool inTime(Vertex v, std::uint32_t t) const;
  const Stay* nextVisit(Vertex v, std::uint32_t t) const;
  std::uint32_t distanceOf(Vertex v) const { return way_left_(v); }
  /// What comes first among states of a weight: 3 instead of 2 for the way that is left gains no
  /// more.
  std::size_t keyOf(std::uint32_t time, std::uint32_t distance) const {
    if (hurries()) return (time + std::size_t{distance}) * stepsADelay() + distance;
    return time + std::size_t{query_->hasty ? 2U : 1U} * distance;
  }
  std::size_t keyOf(std::uint32_t index) const {
    return keyOf(queue_[index].time, distanceOf(queue_[index].vertex));
  }
  std::uint32_t stepsADelay() const {
    const bool greedy = query_->hurry.greedy != Hurry::kNever;
    return greedy ? Hurry::kGreedyStepsADelay : Hurry::kStepsADelay;
  }
  bool hurries() const { return query_->hurry.begin != Hurry::kNever; }
  std::uint32_t weightOf(const Stay& stay) const { return (*query_->weights)[stay.robot]; }
  bool isFixed(const Stay& stay) const { return weightOf(stay) == EvictionQuery::kFixed; }

  const Graph& graph_;
  const EvictionQuery* query_ = nullptr;
  WayLeft way_left_;
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
  // Evicting costs at least 1, so it waits for the weight above that of the state it starts from,
  // and there for its turn over arrival: most searches end before it has come for most states.
  std::vector<std::uint32_t> expanded_;  // states of what is open, ordered by key
  std::vector<std::uint32_t> turn_;      // states of the weight below
  std::size_t evicted_ = 0;              // of turn_, from so many
};

}  // namespace split_mapf
