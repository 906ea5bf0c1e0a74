#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/objective.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// Looks for the optimum, or the proof that a plan is one, by search over the joint states of the
/// robots that are in each other's way: in turns, each with more states than the last, until there
/// are more than it may take. For makespan, once that is proved, the least sum of costs within it.
/// Not thread-safe.
class Settlement {
 public:
  static constexpr const char* kEngine = "joint";  ///< certifies what is proved here

  /// @param lower_bound  proved for the objective [steps]. @pre the instance outlives this object.
  Settlement(const Instance& instance, Objective objective, std::uint64_t lower_bound);

  /// Whether another turn may tell more about a plan.
  bool isOpen(const Plan& plan) const {
    return states_ <= kMostStates && (!isOptimal(plan) || !isBest(plan));
  }
  /// A better plan, if there is one and the turn was long enough. Bounds may rise either way.
  /// Too little memory ends the turns.
  std::optional<Plan> takeTurn(const Plan& plan, const Deadline& deadline);

  /// Told what is proved, of the objective, and for makespan of the sum of costs within it.
  using Proved = std::function<void(Objective, std::uint64_t bound)>;
  /// Tells each bound that has risen since the last call; null: nobody is told.
  void tellNew(const Proved& proved);

  /// That the next turn may take.
  std::uint64_t states() const { return states_; }
  /// Proved for the objective [steps].
  std::uint64_t lowerBound() const { return bound_; }
  /// Proved for the sum of costs, for makespan of the plans of least makespan [steps].
  std::uint64_t leastSum() const { return sum_bound_; }
  bool isOptimal(const Plan& plan) const { return costOf(plan, objective_) <= bound_; }
  /// Whether nothing is left to gain. For makespan: in sums of costs either.
  bool isBest(const Plan& plan) const {
    return isOptimal(plan) && sumOfCostsOf(plan) <= sum_bound_;
  }

 private:
  std::optional<Plan> search(const Plan& plan, const Deadline& deadline);

  static constexpr std::uint64_t kFirstStates = 50000;
  static constexpr std::uint64_t kMostStates = 3200000;  // some 300 MB

  const Instance& instance_;
  const Objective objective_;
  std::uint64_t bound_;
  std::uint64_t sum_bound_;
  std::uint64_t told_bound_;
  std::uint64_t told_sum_;
  std::uint64_t states_ = kFirstStates;  // of the next turn
};

}  // namespace split_mapf
