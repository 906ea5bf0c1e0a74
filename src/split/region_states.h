#pragma once

#include <cstdint>
#include <vector>

#include "split/assignment.h"
#include "split/intermediate_states.h"
#include "split/region_graph.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/split/space_split.h"

namespace split_mapf {

/// What is asked for one region of one phase.
struct RegionQuestion {
  const Ownership* ownership = nullptr;  ///< of this phase
  std::uint32_t region = 0;
  std::uint32_t turn = 0;  ///< which partition the phase belongs to
  std::vector<std::uint32_t> robots;
  const std::vector<Vertex>* from = nullptr;  ///< where all robots are
  TimeShare share;                            ///< T1 and T2
  std::uint32_t phases_left = 1;              ///< this one included
  std::uint32_t attempt = 0;                  ///< draws before this one
  /// Where each robot's region of the next phase is fixed: the states it had; null otherwise.
  const std::vector<Vertex>* former = nullptr;
};

/// Chooses where the robots of a region are to be when a phase ends: the paper's Algorithms 2 and
/// 3. Keeps its memory between questions; not thread-safe.
class RegionStates {
 public:
  RegionStates(const Instance& instance, const Partition& partition,
               const SpaceSplitOptions& options);

  /// One vertex of the region for each of the question's robots, all different. Never without an
  /// answer where `former` is null, as the region has a vertex for every robot in it; empty when
  /// `former` leaves too little, or when the deadline expired.
  std::vector<Vertex> choose(const RegionQuestion& question, const Deadline& deadline);

  /// How many phases a robot needs from `from` on, when the first of them is of `turn`.
  std::uint32_t phasesNeeded(std::uint32_t robot, Vertex from, std::uint32_t turn) const;

 private:
  /// What does not change while the cells are rated for one robot.
  struct Rater {
    std::uint32_t robot;
    const DistanceTable* to_goal;
    std::uint32_t length;       // of the shortest way from here
    std::uint32_t phases_now;   // that the robot needs from here
    std::uint32_t nearest_now;  // how near to the goal its region gets
    std::uint32_t next_region;  // that it must have in the next phase, or kNoRegion
    // By region of the next phase: phases to the goal's, and the least distance to the goal.
    const std::uint32_t* next_hops;
    const std::uint32_t* next_nearest;
  };

  /// @param to_goal  the robot's; it outlives the rater.
  Rater raterFor(const RegionQuestion& question, std::uint32_t robot,
                 const DistanceTable& to_goal) const;
  /// Rates all cells of the region that the robot may take, into rated_.
  void rateAll(const RegionQuestion& question, std::uint32_t robot);
  std::uint32_t rate(const RegionQuestion& question, const Rater& rater, Vertex v,
                     std::uint32_t walked) const;
  std::uint32_t stayPenalty(const RegionQuestion& question, const Rater& rater, Vertex v) const;
  std::uint32_t narrowness(Vertex v) const;
  std::uint32_t takenAround(Vertex v) const;
  std::vector<Vertex> matchAll(const RegionQuestion& question, const Deadline& deadline);
  std::vector<std::uint32_t> servingOrder(const RegionQuestion& question) const;
  /// The cell of the least f that nobody has; kNoVertex when there is none.
  Vertex takeBest(const RegionQuestion& question, std::uint32_t robot);
  const std::uint32_t* nearest(std::uint32_t robot, const DistanceTable& to_goal,
                               std::uint32_t turn) const;

  const Instance& instance_;
  const Partition& partition_;
  const SpaceSplitOptions& options_;
  RegionGraph regions_;
  std::vector<std::uint32_t> region_count_;  // of the two ownerships
  // For each robot, by region of either ownership: the least distance of a cell to the goal.
  mutable std::vector<std::vector<std::uint32_t>> nearest_;

  std::vector<bool> used_;
  std::vector<std::uint32_t> seen_;
  std::vector<std::uint32_t> walked_;
  std::vector<Vertex> queue_;
  std::vector<Candidate> rated_;
  std::uint32_t search_number_ = 0;
};

}  // namespace split_mapf
