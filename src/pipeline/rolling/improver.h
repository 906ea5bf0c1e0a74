#pragma once

#include <cstdint>
#include <vector>

#include "parallel/thread_team.h"
#include "pipeline/rolling/fleet_window.h"
#include "pipeline/rolling/window_search.h"
#include "search/apart.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/pipeline/rolling.h"

namespace split_mapf::rolling {

/// Improves a window by neighbourhoods: a delayed robot and some of those in its way give up their
/// tracks and are planned anew, one after the other. Neighbourhoods are tried in batches, each
/// against the window as it was at the batch's begin; what came of them is taken in order, where
/// nobody else of the batch is in the way. So what comes out does not depend on the threads.
/// Source: large-neighbourhood search after Li et al. (IJCAI 2021), for windows; ours.
class Improver {
 public:
  /// Neighbourhoods that are tried at a time: more threads are of no use.
  static constexpr std::uint32_t kBatch = RollingOptions::kMostThreads;

  /// @pre graph and team outlive this object.
  Improver(const MoveGraph& graph, const std::vector<bool>& closed, std::uint32_t steps,
           ThreadTeam& team, std::uint64_t seed);

  /// Other vertices are closed from the next begin() on.
  void close(const std::vector<bool>& closed);
  /// @pre the window's tracks are valid; it outlives this object, or the next begin().
  void begin(FleetWindow& window);
  /// @return expansions done; 0 when nobody is delayed.
  std::uint64_t improve(std::uint64_t expansions, const Deadline& deadline);

 private:
  static constexpr std::uint32_t kMostMembers = 8;

  struct Member {
    std::uint32_t robot = 0;
    std::uint32_t cost = 0;
    Track track;
  };
  /// One try, and what came of it.
  struct Proposal {
    explicit Proposal(std::uint64_t seed) : engine(seed) {}
    RandomEngine engine;
    std::vector<std::uint32_t> robots;
    std::vector<Member> members;
    bool taken = false;
    std::uint64_t expansions = 0;
  };
  struct Change {
    std::uint32_t robot;
    std::uint32_t from;
    Track before;
    Track after;
  };
  struct Worker {
    WindowTable table;
    WindowSearch search;
    std::size_t repeated = 0;  // of the changes
  };

  void tryOne(Worker& worker, Proposal& proposal);
  void choose(Proposal& proposal) const;
  void walk(std::uint32_t robot, std::uint32_t from, std::uint32_t size, Proposal& proposal) const;
  void meet(std::uint32_t robot, Vertex v, Vertex to, std::uint32_t t, std::uint32_t size,
            Proposal& proposal) const;
  bool replan(Worker& worker, Proposal& proposal) const;
  bool take(Proposal& proposal);
  void repeatChanges(Worker& worker) const;
  void setCost(std::uint32_t robot, std::uint32_t cost);
  void note(std::uint32_t robot);
  std::uint32_t whoIs(Vertex v, std::uint32_t t) const;
  const Itinerary& itinerary(std::uint32_t robot) const { return window_->itineraries[robot]; }

  const MoveGraph& graph_;
  std::uint32_t steps_;
  ThreadTeam& team_;
  std::vector<Apart<Worker>> workers_;
  std::vector<Apart<Proposal>> proposals_;
  FleetWindow* window_ = nullptr;
  std::vector<std::uint32_t> who_;    // by step, then vertex: who was seen there last
  std::vector<std::uint32_t> costs_;  // by robot, behind free_from
  std::vector<std::uint32_t> delayed_;
  std::vector<std::uint32_t> place_;    // by robot: in delayed_
  std::vector<std::uint64_t> touched_;  // by robot: the batch that changed its track
  std::vector<Change> changes_;
  std::uint64_t batch_ = 0;
};

}  // namespace split_mapf::rolling
