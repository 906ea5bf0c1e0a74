#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "solver/lacam/crowd_guides.h"
#include "solver/lacam/crowd_state.h"
#include "solver/lacam/pibt.h"
#include "solver/lacam/robot_distances.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// How a crowd walks.
struct CrowdWalkOptions {
  std::uint64_t interval = 40;        ///< steps after which everybody is guided again, > 0
  std::uint64_t expansion_limit = 0;  ///< 0: none
  CrowdGuideOptions guides;
};

/// Walks a crowd home step by step, by PIBT, and guides it again on the way: what stands where then
/// is known, and who was pushed off its way gets another. It ends when few are left away, and is no
/// search: it may also end earlier, and whoever is left comes home by a search that is complete.
class CrowdWalk {
 public:
  enum class Outcome { kDone, kSpent, kInterrupted };

  /// @pre nobody is cut off; instance and deadline outlive this object.
  CrowdWalk(const Instance& instance, const CrowdWalkOptions& options, const Deadline& deadline);

  Outcome run();
  /// Where everybody is at its end.
  const Configuration& at() const { return state_.at; }
  /// From the starts to there, all paths of the same length.
  Plan takePlan() { return std::move(plan_); }
  std::uint64_t expansions() const { return guides_.expansions() + pibt_.expansions(); }

 private:
  bool goesOn() const;
  bool isSpent() const;
  std::uint64_t guidesMay() const;
  void take(const Configuration& next);

  const Instance& instance_;
  const CrowdWalkOptions options_;
  const Deadline& deadline_;
  const std::uint32_t longest_;  // steps
  RobotDistances distances_;
  CrowdState state_;
  CrowdGuides guides_;
  Pibt pibt_;
  std::uint32_t away_ = 0;
  std::vector<std::uint32_t> ranks_;  // who goes first among those at home
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> next_order_;
  Plan plan_;
};

}  // namespace split_mapf
