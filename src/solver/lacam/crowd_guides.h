#pragma once

#include <cstdint>
#include <vector>

#include "parallel/thread_team.h"
#include "search/apart.h"
#include "solver/lacam/crowd_state.h"
#include "solver/lacam/home_passes.h"
#include "solver/lacam/priced_ways.h"
#include "solver/lacam/robot_distances.h"
#include "solver/lacam/step_prices.h"
#include "solver/lacam/traffic.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/random.h"
#include "split_mapf/parallel/lent_threads.h"

namespace split_mapf {

/// How a crowd is guided.
struct CrowdGuideOptions {
  std::uint64_t rounds = 3;   ///< in which robots choose at first; later there is one each time
  std::uint32_t margin = 40;  ///< steps beyond the shortest way
  std::uint64_t seed = 0;
  LentThreads threads;  ///< they change nothing but the time
};

/// Guides robots home around those that are at home already, by prices: see PricedSearch. Its
/// prices also tell PIBT whom to push rather not. Memory: see PricedWays, one a robot that is away.
class CrowdGuides : public StepPrices {
 public:
  /// @pre all outlive this object; `state` is the walk's, which goes on between renewals.
  CrowdGuides(const Instance& instance, const RobotDistances& distances, const CrowdState& state,
              const CrowdGuideOptions& options);

  /// Finds ways for all who are away now, one batch after another, with what the others have; at
  /// first what is left of their guides, where they are still on them.
  /// @param most  expansions in all, 0: any number.
  /// @return false when the deadline or the limit came first. Cost: a PricedSearch a robot and
  /// round.
  bool renew(const Deadline& deadline, std::uint64_t most);
  /// Forgets the ways of a robot that is pushed from home: they began elsewhere.
  void forget(std::uint32_t robot) {
    ways_[robot].clear();
    guides_[robot].clear();
  }
  std::uint32_t priceOf(std::uint32_t robot, Vertex v, std::uint32_t occupant) const override;
  std::uint64_t expansions() const { return expansions_; }

 private:
  std::uint32_t priceOfPush(std::uint32_t robot, Vertex v, std::uint32_t occupant) const;
  void keepRestOfGuides();
  void chooseBatch(const std::uint32_t* robots, std::uint32_t count);
  void takeOut(std::uint32_t robot);
  void putIn(std::uint32_t robot);

  const Instance& instance_;
  const RobotDistances& distances_;
  const CrowdState& state_;
  std::uint64_t rounds_;  // of the next renewal
  RandomEngine engine_;
  HomePasses passes_;
  Traffic traffic_;
  std::vector<Path> guides_;      // by robot, from where it was; empty: none
  std::vector<PricedWays> ways_;  // by robot
  ThreadTeam team_;
  std::vector<Apart<PricedSearch>> searches_;  // one a thread
  std::vector<std::uint64_t> searched_;        // expansions, by place in the batch
  std::uint64_t expansions_ = 0;
};

}  // namespace split_mapf
