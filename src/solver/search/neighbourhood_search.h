#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "solver/search/gap_search.h"
#include "solver/search/neighbourhood.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/random.h"

namespace split_mapf {

/// A robot's new path.
struct PathChange {
  std::uint32_t robot = 0;
  Path path;
};

/// Large-neighbourhood search for sum of costs on a valid plan: takes some robots out, from some
/// step on, and plans them anew, one after another in a random order, within what they cost
/// together before. A result of equal cost counts too, as it leads across plateaus. The plan is
/// valid after every step, and its cost grows by no more than the caller allows. Deterministic but
/// for the deadline. Not thread-safe.
/// Source: Li et al., IJCAI 2021; deviations, see NeighbourhoodPicker, and that worse plans may be
/// accepted.
class NeighbourhoodSearch {
 public:
  /// Asked before a change is taken over; false leaves the plan as it was.
  using Accept = std::function<bool(const std::vector<PathChange>& changes)>;

  /// @param latest_arrival  nobody arrives after it. @pre the plan is valid and keeps it, its paths
  /// end at their arrivals; the instance outlives this object.
  NeighbourhoodSearch(const Instance& instance, Plan plan, std::uint32_t latest_arrival,
                      std::uint64_t seed);

  /// Tries one neighbourhood; returns how many steps it gained: less than none where it may become
  /// worse. @param temperature  mean of what it may lose, drawn as in simulated annealing [steps].
  std::int64_t tryOne(const Deadline& deadline, const Accept& accept, double temperature = 0);
  /// Puts a robot on another path. @pre the plan is valid again after the last of such changes.
  void replace(std::uint32_t robot, Path path);

  const Plan& plan() const { return plan_; }
  std::uint64_t expansions() const { return expansions_; }

 private:
  /// A robot of the neighbourhood and the part of its path that it keeps.
  struct Member {
    std::uint32_t robot = 0;
    std::uint32_t kept = 0;       // until this step
    std::uint32_t cost = 0;       // its arrival before
    std::uint32_t set_aside = 0;  // what no other member may use of the budget
  };
  bool pick(double temperature);
  std::uint64_t drawLoss(double temperature);
  bool replan(const Deadline& deadline);
  void releaseWhoIsFree();
  std::uint32_t latestArrival(const Member& member) const;
  Path search(const Member& member, std::uint32_t latest_arrival, const Deadline& deadline);

  const Instance& instance_;
  std::uint32_t latest_arrival_;
  NeighbourhoodPicker picker_;
  RandomEngine engine_;
  GapSearch search_;
  Plan plan_;
  ReservationTable table_;
  std::uint64_t expansions_ = 0;
  Neighbourhood picked_;
  std::vector<Member> members_;      // of the current neighbourhood, as are all of these
  std::vector<PathChange> changes_;  // of the first members
  std::uint64_t budget_ = 0;         // what the other members may cost
  std::uint64_t set_aside_ = 0;      // by them
  std::uint64_t loss_ = 0;           // part of the budget that would make the plan worse
};

}  // namespace split_mapf
