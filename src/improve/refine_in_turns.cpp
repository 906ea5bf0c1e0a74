#include "improve/refine_in_turns.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "improve/settlement.h"

namespace split_mapf {
namespace {

// Searches that go side by side through a turn, whatever the number of threads: the same plans then
// come of a turn at any number of them.
constexpr std::uint32_t kLanes = 4;
// Of a lane, counted (see WorkClock). What is longer shows its plans late.
constexpr double kFirstTurnSec = 0.05;
constexpr double kLongestTurnSec = 3.2;
// How soon a search over joint states may take more of them. A state takes about four times as
// long, but what it proves ends everything else.
constexpr double kSecPerState = 0.25e-6;

/// What is less is better: for the objective, and then for the sum of costs.
std::pair<std::uint64_t, std::uint64_t> keyOf(const Plan& plan, Objective objective) {
  return {costOf(plan, objective), sumOfCostsOf(plan)};
}

bool isBetter(const Plan& a, const Plan& b, Objective objective) {
  return keyOf(a, objective) < keyOf(b, objective);
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
      side.options.threads = 1;
      side.options.small_knot = false;  // that is settled here
      side.options.objective = i == 0 ? Objective::kMakespan : Objective::kSumOfCosts;
      if (!isAskedFor(side)) {
        side.options.lower_bound = lowerBound(instance, side.options.objective);
      }
      if (options.small_knot && options.reserved == nullptr) {
        side.settlement.emplace(instance, side.options.objective, side.options.lower_bound);
      }
      side.best = plans.front();
      for (const Plan& plan : plans) {
        if (isBetter(plan, side.best, side.options.objective)) side.best = plan;
      }
    }
  }

  void run() {
    double seconds = kFirstTurnSec;
    for (std::uint64_t turn = 0; !deadline_.expired();
         seconds = std::min(2 * seconds, kLongestTurnSec)) {
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
    std::optional<Settlement> settlement;  // of a small knot
    double seconds = 0;                    // counted, a lane's
    bool is_done = false;                  // no more turns
  };

  /// One search of a turn, and what came of it.
  struct Lane {
    RefineOptions options;
    std::vector<Plan> plans;  // each better than the last, for the objective of the turn
    bool is_best = false;     // nothing is left to gain
  };
  using Lanes = std::array<Lane, kLanes>;

  bool isAskedFor(const Side& side) const { return side.options.objective == asked_.objective; }
  const Plan& shown() const { return sides_[isAskedFor(sides_[0]) ? 0 : 1].best; }

  void takeTurn(Side& side, std::uint64_t turn, double seconds) {
    if (side.is_done) return;
    side.seconds += seconds;
    const auto stop = std::make_shared<StopFlag>(deadline_.stopFlag());
    // What the others find is of no use then. Other turns must not depend on who was first.
    const auto stop_others = [&] {
      if (isAskedFor(side)) stop->request();
    };
    Lanes lanes;
    std::optional<Plan> settled;
    std::vector<Executor::Job> jobs(lanes.size());
    for (std::uint64_t i = 0; i < lanes.size(); ++i) {
      Lane& lane = lanes[i];
      lane.options = side.options;
      lane.options.seed += (turn << 32U) + (i << 28U);  // other draws than before
      jobs[i].run = [&, seconds] {
        run(lane, side.best, deadline_.withStop(stop), seconds);
        if (lane.is_best) stop_others();
      };
    }
    if (maySettle(side)) {
      jobs.push_back({1, [&] {
                        settled = side.settlement->takeTurn(side.best, deadline_.withStop(stop));
                        if (side.settlement->isBest(settled ? *settled : side.best)) stop_others();
                      }});
    }
    executor_.run(std::move(jobs), asked_.threads, deadline_);
    takeAll(side, lanes, settled);
  }

  static bool maySettle(const Side& side) {
    return side.settlement && side.settlement->isOpen(side.best) &&
           static_cast<double>(side.settlement->states()) * kSecPerState <= side.seconds;
  }

  /// Counts instead of measuring, so that a lane finds the same as ever, or the first part of it.
  void run(Lane& lane, const Plan& plan, const Deadline& deadline, double seconds) const {
    const Deadline end = deadline.countedBy(std::make_shared<WorkClock>()).within(seconds);
    Executor executor(Executor::OnCallersThread{});
    refine(instance_, plan, lane.options, executor, end,
           [&lane](const Plan& better) { lane.plans.push_back(better); });
    lane.is_best = !end.expired();
  }

  void takeAll(Side& side, const Lanes& lanes, const std::optional<Plan>& settled) {
    const auto before = keyOf(shown(), asked_.objective);
    if (settled) take(*settled);
    for (const Lane& lane : lanes) {
      side.is_done = side.is_done || lane.is_best;
      for (const Plan& plan : lane.plans) take(plan);
    }
    takeBounds(side);
    if (keyOf(shown(), asked_.objective) < before) improved_(shown());
  }

  void take(const Plan& plan) {
    for (Side& side : sides_) {
      if (isBetter(plan, side.best, side.options.objective)) side.best = plan;
    }
  }

  void takeBounds(Side& side) {
    if (!side.settlement) return;
    side.is_done = side.is_done || side.settlement->isBest(side.best);
    side.options.lower_bound = side.settlement->lowerBound();
    if (isAskedFor(side)) side.settlement->tellNew(asked_.proved);
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
