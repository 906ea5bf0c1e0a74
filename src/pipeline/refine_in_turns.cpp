#include "pipeline/refine_in_turns.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

namespace split_mapf {
namespace {

// Of either objective. Shorter ones than a round of refine() show less than they cost.
constexpr double kFirstTurnSec = 0.2;

/// For the objective, and then for the sum of costs.
bool isBetter(const Plan& a, const Plan& b, Objective objective) {
  const auto key = [objective](const Plan& plan) {
    return std::make_pair(costOf(plan, objective), sumOfCostsOf(plan));
  };
  return key(a) < key(b);
}

/// One call of refineInTurns().
class Turns {
 public:
  Turns(const Instance& instance, const std::vector<Plan>& plans, const RefineOptions& options,
        Executor& executor, const Deadline& deadline,
        const std::function<void(const Plan&)>& improved)
      : instance_(instance),
        asked_(options),
        executor_(executor),
        deadline_(deadline),
        improved_(improved) {
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      Side& side = sides_[i];
      side.options = options;
      side.options.objective = i == 0 ? Objective::kMakespan : Objective::kSumOfCosts;
      if (!isAskedFor(side)) {
        side.options.lower_bound = lowerBound(instance, side.options.objective);
      }
      side.options.proved = [this, &side](Objective objective, std::uint64_t bound) {
        takeBound(side, objective, bound);
      };
      side.best = plans.front();
      for (const Plan& plan : plans) {
        if (isBetter(plan, side.best, side.options.objective)) side.best = plan;
      }
    }
  }

  void run() {
    double seconds = kFirstTurnSec;
    for (std::uint64_t turn = 0; !deadline_.expired(); seconds *= 2) {
      for (Side& side : sides_) {
        takeTurn(side, turn++, seconds);
        if (isAskedFor(side) && side.is_done) return;
      }
    }
  }

 private:
  /// What is known for one objective.
  struct Side {
    RefineOptions options;
    Plan best;
    bool is_done = false;  ///< no more turns
  };

  bool isAskedFor(const Side& side) const { return side.options.objective == asked_.objective; }

  void takeTurn(Side& side, std::uint64_t turn, double seconds) {
    if (side.is_done) return;
    const Deadline end = deadline_.within(seconds);
    RefineOptions options = side.options;
    options.seed += turn << 32U;  // other draws than before
    refine(instance_, side.best, options, executor_, end, [this](const Plan& plan) { take(plan); });
    if (!end.expired()) side.is_done = true;
    const bool is_least = costOf(side.best, side.options.objective) <= side.options.lower_bound;
    if (!isAskedFor(side) || !is_least) return;
    for (Side& other : sides_) other.is_done = other.is_done || !isAskedFor(other);
  }

  void take(const Plan& plan) {
    for (Side& side : sides_) {
      if (!isBetter(plan, side.best, side.options.objective)) continue;
      side.best = plan;
      if (isAskedFor(side)) improved_(plan);
    }
  }

  void takeBound(Side& side, Objective objective, std::uint64_t bound) {
    if (objective == side.options.objective) {
      side.options.lower_bound = std::max(side.options.lower_bound, bound);
    }
    if (isAskedFor(side) && asked_.proved) asked_.proved(objective, bound);
  }

  const Instance& instance_;
  const RefineOptions& asked_;
  Executor& executor_;
  const Deadline& deadline_;
  const std::function<void(const Plan&)>& improved_;
  std::array<Side, 2> sides_;
};

}  // namespace

void refineInTurns(const Instance& instance, const std::vector<Plan>& plans,
                   const RefineOptions& options, Executor& executor, const Deadline& deadline,
                   const std::function<void(const Plan&)>& improved) {
  Turns(instance, plans, options, executor, deadline, improved).run();
}

}  // namespace split_mapf
