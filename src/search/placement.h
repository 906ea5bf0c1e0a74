#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "parallel/thread_team.h"
#include "search/apart.h"
#include "search/batch_size.h"
#include "search/eviction_search.h"
#include "search/placement_forecast.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/random.h"
#include "split_mapf/core/reservations.h"
#include "split_mapf/parallel/lent_threads.h"

namespace split_mapf {

/// Places robots within a horizon: who is placed and where, who waits, what everybody weighs. Each
/// takes the path that displaces placed robots of the least weight; who is displaced waits again
/// and weighs more, the square of how often it waited. The placed paths never conflict. Not
/// thread-safe. The next few robots of the queue are searched for side by side, against what is
/// placed, and then placed one after another; who meets one placed before it in the same batch
/// waits for the next. Where that happens often, batches are small. None of it depends on the
/// number of threads.
class Placement {
 public:
  static constexpr std::uint64_t kNoLimit = ~std::uint64_t{0};
  /// Placings that depart late, once a horizon has proved hard.
  static constexpr std::uint32_t kDelayedOneIn = 4;
  enum class Outcome {
    kDone,         ///< nobody waits
    kSpent,        ///< the patience is over
    kExhausted,    ///< the expansions are
    kHopeless,     ///< they would be, long before everybody is placed
    kJammed,       ///< a longer horizon is likely to take less
    kInterrupted,  ///< the deadline
  };

  /// @param queue  everybody, in the order of the first placing. @param reserved  placed for good
  /// before all; null: nothing is. The instance outlives this object.
  Placement(const Instance& instance, const std::vector<std::uint32_t>& queue, std::uint64_t seed,
            const LentThreads& threads, const Reservations* reserved = nullptr);

  /// Starts from a plan: everybody who arrives by `horizon` is placed, the others wait.
  /// @pre the plan is valid and its paths end at their arrivals.
  Placement(const Instance& instance, const Plan& plan, std::uint32_t horizon, std::uint64_t seed,
            const LentThreads& threads = {}, const Reservations* reserved = nullptr);

  struct Effort {
    /// Placements without fewer robots waiting than ever before in this run.
    std::uint64_t patience = 0;
    std::uint64_t expansion_limit = 0;  ///< in all runs; 0: none
    /// Gives up as soon as the limit is foreseen to be passed, see PlacementForecast; without one
    /// it does nothing.
    bool forecasts = false;
    /// Gives the horizon up as soon as so many expansions in all runs are foreseen for it; 0:
    /// never.
    std::uint64_t jam_limit = 0;
    /// Called once as soon as all runs have taken more than `late_after` expansions; null: never.
    const std::function<void()>* on_late = nullptr;
    std::uint64_t late_after = 0;
    /// How often a robot may be displaced; a robot that could only displace one that was displaced
    /// so often is left over.
    std::uint64_t displacements = kNoLimit;
    /// One placing in so many departs a random while later, as some knots need a robot that lets
    /// the others pass first; 0: none does.
    std::uint32_t delayed_one_in = 0;
    /// See EvictionQuery: for who wants a plan within the horizon, and no more.
    bool hasty = false;
    /// Searches are in a Hurry, the sooner the fewer cells a robot there are.
    bool hurries = false;
  };
  /// Places who waits until nobody does or the effort is spent. @pre horizon >= every robot's
  /// shortest path around what is reserved.
  Outcome run(std::uint32_t horizon, const Effort& effort, const Deadline& deadline);
  std::uint64_t expansions() const { return expansions_; }
  const Plan& plan() const { return plan_; }
  /// Who has no path and waits no more, in order.
  const std::vector<std::uint32_t>& leftOver() const { return left_over_; }

 private:
  struct Candidate {
    std::uint32_t robot = 0;
    std::uint32_t departure = 0;
    GapAnswer answer;
  };
  void drawBatch(std::uint32_t horizon, const Effort& effort);
  /// Safe to call for several candidates at once, with a search for each.
  void search(Candidate& candidate, EvictionSearch& search, std::uint32_t horizon,
              const Effort& effort, const Deadline& deadline) const;
  void searchBatch(std::uint32_t horizon, const Effort& effort, const Deadline& deadline);
  void tellWhenLate(const Effort& effort);
  bool isJammed(PlacementForecast& forecast, std::uint64_t jam_limit) const;
  bool place(Candidate& candidate, std::uint64_t displacements);
  bool mayDisplace(const std::vector<std::uint32_t>& robots, std::uint64_t displacements) const;
  void remove(std::uint32_t robot);
  void requeue(std::uint32_t robot);
  std::uint32_t drawDeparture(std::uint32_t robot, std::uint32_t horizon, std::uint32_t one_in);

  const Instance& instance_;
  const bool is_reserved_;
  RandomEngine engine_;
  ThreadTeam team_;
  std::vector<Apart<EvictionSearch>> searches_;  // one a thread
  ReservationTable table_;
  Plan plan_;                           // an empty path: waits
  std::deque<std::uint32_t> queue_;     // next first
  std::vector<std::uint32_t> queued_;   // how often, by robot
  std::vector<std::uint32_t> weights_;  // by robot, then of the reserved paths
  std::vector<std::uint32_t> left_over_;
  std::vector<Candidate> batch_;
  std::vector<std::uint32_t> placed_in_;  // by robot: number of the batch that placed it last
  std::uint32_t batch_number_ = 0;
  BatchSize batch_size_;
  std::uint64_t expansions_ = 0;
  bool is_late_ = false;
};

}  // namespace split_mapf
