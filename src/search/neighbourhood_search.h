#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "search/adaptive_choice.h"
#include "search/ejection_chain.h"
#include "search/gap_search.h"
#include "search/neighbourhood.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/random.h"
#include "split_mapf/core/reservations.h"

namespace split_mapf {

/// Large-neighbourhood search for sum of costs on a valid plan. Either a delayed robot takes an
/// earlier path and a chain of ejections makes room for it (see EjectionChain), or some robots are
/// taken out, from some step on, and planned anew, one after another in a random order, within what
/// they cost together before. What gains more for its effort is tried more often. A result of equal
/// cost counts too, as it leads across plateaus. The plan is valid after every step, and its cost
/// grows by no more than the caller allows. Deterministic but for the deadline. Not thread-safe.
/// Source: Li et al., IJCAI 2021; deviations: the chains, see NeighbourhoodPicker, that worse plans
/// may be accepted, and where waits go (see WaitPlacer).
class NeighbourhoodSearch {
 public:
  /// Asked before a change is taken over; false leaves the plan as it was.
  using Accept = std::function<bool(const std::vector<PathChange>& changes)>;

  /// @param latest_arrival  nobody arrives after it. @pre the plan is valid and keeps it, its paths
  /// end at their arrivals; the instance outlives this object.
  /// @param departures  kept by the plan, as by all that come of it. @param reserved  likewise;
  /// null: nothing is reserved. @param headway  likewise, see ReservationTable.
  NeighbourhoodSearch(const Instance& instance, Plan plan, std::uint32_t latest_arrival,
                      std::uint64_t seed, const Departures& departures = {},
                      const Reservations* reserved = nullptr, std::uint32_t headway = 0);
  /// The same with a table that is known already: of the plan, and of so many paths behind it that
  /// are reserved.
  NeighbourhoodSearch(const Instance& instance, ReservationTable table, Plan plan,
                      std::uint32_t latest_arrival, std::uint64_t seed,
                      const Departures& departures = {}, std::size_t reserved = 0);

  /// Tries one chain or neighbourhood; returns how many steps it gained: less than none where it
  /// may become worse. @param temperature  mean of what it may lose, drawn as in simulated
  /// annealing [steps].
  std::int64_t tryOne(const Deadline& deadline, const Accept& accept, double temperature = 0);
  /// See DelayedRobots.
  void expect(std::vector<std::uint32_t> arrivals) {
    picker_.delayed().expect(std::move(arrivals));
  }
  /// Puts a robot on another path. @pre the plan is valid again after the last of such changes.
  void replace(std::uint32_t robot, Path path);

  const Plan& plan() const { return plan_; }
  /// Of the plan; while a change is asked about, with that change.
  const ReservationTable& table() const { return table_; }
  std::uint64_t expansions() const { return work().expansions; }
  SearchWork work() const {
    SearchWork sum = work_;
    return sum += chain_.work();
  }

 private:
  /// A robot of the neighbourhood and the part of its path that it keeps.
  struct Member {
    std::uint32_t robot = 0;
    std::uint32_t kept = 0;       // until this step
    std::uint32_t cost = 0;       // its arrival before
    std::uint32_t set_aside = 0;  // what no other member may use of the budget
  };
  enum Method { kChain, kNeighbourhood, kMethods };
  static constexpr std::array<std::size_t, 2> kChainSearches = {8, 32};
  static constexpr std::array<std::uint32_t, 3> kChainReaches = {4, 16, 64};

  std::int64_t tryChain(const Deadline& deadline, const Accept& accept, double temperature);
  std::int64_t tryNeighbourhood(const Deadline& deadline, const Accept& accept, double temperature);
  bool pick(double temperature);
  std::uint64_t drawLoss(double temperature);
  void undo();
  bool replan(const Deadline& deadline);
  void releaseWhoIsFree();
  std::uint32_t latestArrival(const Member& member) const;
  Path search(const Member& member, std::uint32_t latest_arrival, const Deadline& deadline);

  const Instance& instance_;
  const Departures departures_;
  std::uint32_t latest_arrival_;
  NeighbourhoodPicker picker_;
  RandomEngine engine_;
  AdaptiveChoice<kMethods> methods_;
  AdaptiveChoice<kChainSearches.size()> chain_searches_;
  AdaptiveChoice<kChainReaches.size()> chain_reaches_;
  AdaptiveChoice<2> chain_hastes_;  // haste gains more where robots crowd, less elsewhere
  GapSearch search_;
  WaitPlacer waits_;
  EjectionChain chain_;
  Plan plan_;
  ReservationTable table_;
  SearchWork work_;  // by neighbourhoods
  Neighbourhood picked_;
  std::vector<Member> members_;      // of the current neighbourhood, as are all of these
  std::vector<PathChange> changes_;  // of the first members
  std::uint64_t budget_ = 0;         // what the other members may cost
  std::uint64_t set_aside_ = 0;      // by them
  std::uint64_t loss_ = 0;           // part of the budget that would make the plan worse
};

}  // namespace split_mapf
