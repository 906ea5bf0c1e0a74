#include "split_mapf/improve/refine.h"

#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "improve/annealing.h"
#include "improve/incumbent.h"
#include "improve/refine_worker.h"
#include "improve/settlement.h"
#include "improve/window_descent.h"
#include "portfolio/solver_choice.h"
#include "search/placement.h"
#include "search/retiming.h"
#include "solver/joint/group_search.h"
#include "solver/reserved_paths.h"

namespace split_mapf {
namespace {

// Between rounds the plan is shown, and other callers of the executor get their turn.
constexpr double kRoundSec = 0.2;
// Placements a robot without progress before a descent is given up; doubled each time.
constexpr std::uint64_t kFirstPatience = 5;
// Windows that a plan is cut into, and what a window may take for a unit of patience.
constexpr std::array<std::uint32_t, 4> kWindowCuts = {1, 2, 4, 8};
constexpr std::uint64_t kWindowExpansions = 20000;
// Fewer robots soon come to where neighbourhoods gain nothing any more: after so many rounds in
// vain the next ones try other ways. Larger teams gain more by going on.
constexpr std::uint32_t kSmallTeam = 100;
constexpr std::uint32_t kRoundsInVain = 4;
constexpr std::uint64_t kPatienceElsewhere = 20;

/// One call of refine().
class Refinement {
 public:
  Refinement(const Instance& instance, Plan plan, const RefineOptions& options, Executor& executor,
             const Deadline& deadline, const std::function<void(const Plan&)>& improved)
      : instance_(instance),
        options_(options),
        executor_(executor),
        deadline_(deadline),
        improved_(improved),
        annealing_(deadline),
        reserved_(instance, options.reserved, deadline),
        settlement_(instance, options.objective, options.lower_bound),
        plan_(std::move(plan)),
        cost_(sumOfCostsOf(plan_)) {
    const bool has_windows = options.solvers != nullptr && !reserved_.any();
    if (has_windows) window_solvers_ = windowSolvers(options.solvers->traits());
  }

  Plan run() {
    if (reserved_.refusal()) return std::move(plan_);
    while (!deadline_.expired() && !isBest()) {
      const bool may_descend = mayDescend();
      if (maySettle() && settling_sec_ <= descents_sec_ + search_sec_) {
        timed(settling_sec_, [this] { settle(); });
      } else if (may_descend && descents_sec_ <= search_sec_) {
        timed(descents_sec_, [this] {
          if (!descend()) shortenSomeWindow();
        });
      } else if (may_descend && cost_ <= settlement_.leastSum()) {
        search_sec_ = descents_sec_;  // nothing else is left to do
      } else {
        timed(search_sec_, [this] { search(); });
      }
    }
    return std::move(plan_);
  }

 private:
  bool isBest() const {
    return settlement_.isBest(plan_) || (makespanOf(plan_) <= reserved_.makespanBound() &&
                                         cost_ <= reserved_.lowerBound(Objective::kSumOfCosts));
  }
  bool mayDescend() const {
    return ruleOf(options_.objective).greatest_only && !settlement_.isOptimal(plan_) &&
           makespanOf(plan_) > reserved_.makespanBound();
  }
  bool maySettle() const {
    return options_.small_knot && !reserved_.any() && settlement_.isOpen(plan_);
  }

  template <typename Work>
  void timed(double& seconds, Work work) {
    const double begin_sec = deadline_.nowSec();
    work();
    seconds += deadline_.nowSec() - begin_sec;
  }

  void take(Plan plan) {
    plan_ = std::move(plan);
    cost_ = sumOfCostsOf(plan_);
    improved_(plan_);
  }

  /// One that the workers do not know of.
  void takeElsewhere(Plan plan) {
    workers_.clear();
    in_vain_ = 0;
    take(std::move(plan));
  }

  /// A turn of the search over joint states; others of the executor's callers get theirs before it.
  void settle() {
    std::optional<Plan> better;
    std::vector<Executor::Job> jobs(1);
    jobs[0].run = [&] { better = settlement_.takeTurn(plan_, deadline_); };
    executor_.run(std::move(jobs), 1, deadline_);
    settlement_.tellNew(options_.proved);
    if (better) takeElsewhere(std::move(*better));
  }

  bool descend() {
    std::optional<Plan> sooner = descendFrom(plan_, patience_);
    if (!sooner) {
      patience_ *= 2;
      return false;
    }
    takeElsewhere(std::move(*sooner));
    return true;
  }

  /// Each worker tries to make everybody arrive a step earlier; the first to succeed stops the
  /// others.
  std::optional<Plan> descendFrom(const Plan& plan, std::uint64_t patience) {
    if (makespanOf(plan) <= reserved_.makespanBound()) return std::nullopt;
    const auto stop = std::make_shared<StopFlag>(deadline_.stopFlag());
    const Deadline deadline = deadline_.withStop(stop);
    const std::uint32_t horizon = makespanOf(plan) - 1;
    std::mutex mutex;
    std::optional<Plan> found;
    std::vector<Executor::Job> jobs(options_.threads);
    for (Executor::Job& job : jobs) {
      job.run = [&, seed = ++descents_ + options_.seed] {
        Placement placement(instance_, plan, horizon, seed, {}, reserved_.paths());
        Placement::Effort effort;
        effort.patience = patience * instance_.robots();
        effort.delayed_one_in = Placement::kDelayedOneIn;
        effort.hasty = true;
        if (placement.run(horizon, effort, deadline) != Placement::Outcome::kDone) return;
        const std::lock_guard<std::mutex> lock(mutex);
        if (!found) found = placement.plan();
        stop->request();
      };
    }
    executor_.run(std::move(jobs), options_.threads, deadline_);
    return found;
  }

  /// Solves windows anew, each time in another way, until one way gains a step or none does.
  void shortenSomeWindow() {
    for (std::size_t tried = 0; tried < window_solvers_.size() * kWindowCuts.size(); ++tried) {
      if (deadline_.expired()) return;
      const auto cut = kWindowCuts[window_rounds_ / window_solvers_.size() % kWindowCuts.size()];
      WindowOptions options;
      options.solver = window_solvers_[window_rounds_ % window_solvers_.size()];
      options.width = std::max(2U, makespanOf(plan_) / cut);
      options.offset = window_rounds_ % 4 < 2 ? options.width : (options.width + 1) / 2;
      options.expansion_limit = kWindowExpansions * patience_;
      options.seed = options_.seed + window_rounds_++;
      options.threads = options_.threads;
      std::optional<Plan> shorter =
          shortenWindows(instance_, plan_, options, *options_.solvers, executor_, deadline_);
      if (shorter) return takeElsewhere(std::move(*shorter));
    }
  }

  /// Mostly neighbourhoods; where these gain nothing any more, by turns.
  void search() {
    const bool stuck = instance_.robots() < kSmallTeam && in_vain_ >= kRoundsInVain;
    const std::uint32_t turn = stuck ? ++turns_ % 3 : 0;
    if (turn == 1 && !reserved_.any()) return searchGroups();
    if (turn == 2 && ruleOf(options_.objective).sums()) return searchSooner();
    if (turn == 2 && mayDescend()) return searchLater();
    searchNeighbourhoods();
  }

  void searchNeighbourhoods() {
    if (workers_.empty()) {
      if (!reserved_.any()) placeWaits(instance_.graph().size(), plan_);
      workers_ = employ(incumbent_, plan_, latestArrival());
    }
    // Between descents there is no telling how much time is left for this.
    const Annealing* const annealing = mayDescend() ? nullptr : &annealing_;
    Plan now = runWorkers(*incumbent_, workers_, annealing);
    const std::uint64_t cost = sumOfCostsOf(now);
    in_vain_ = cost < cost_ ? 0 : in_vain_ + 1;
    if (cost < cost_) {
      take(std::move(now));
    } else if (cost == cost_) {
      plan_ = std::move(now);
    }
  }

  /// The best that small groups of robots can do among all others.
  void searchGroups() {
    const Deadline round = deadline_.within(kRoundSec);
    std::vector<std::optional<GroupSearch>> searches(options_.threads);
    std::vector<Executor::Job> jobs(options_.threads);
    for (std::uint32_t i = 0; i < options_.threads; ++i) {
      jobs[i].run = [&, i, seed = ++group_rounds_ + options_.seed] {
        searches[i].emplace(instance_, plan_, latestArrival(), seed);
        while (!round.expired() && sumOfCostsOf(searches[i]->plan()) > settlement_.leastSum()) {
          searches[i]->tryOne(round);
        }
      };
    }
    executor_.run(std::move(jobs), options_.threads, deadline_);
    for (const std::optional<GroupSearch>& search : searches) {
      if (search && sumOfCostsOf(search->plan()) < cost_) takeElsewhere(search->plan());
    }
  }

  /// For sum of costs: from a plan of less makespan. Its own sum may be greater at first.
  void searchSooner() {
    std::optional<Plan> sooner = descendFrom(other_ ? *other_ : plan_, kPatienceElsewhere);
    other_.reset();
    if (!sooner) return;
    Plan found = searchFrom(std::move(*sooner));
    if (sumOfCostsOf(found) < cost_) return takeElsewhere(std::move(found));
    other_ = std::move(found);
  }

  /// For makespan: from a plan in which robots may arrive later, if all together cost less.
  void searchLater() {
    Plan found = searchFrom(other_ ? *std::move(other_) : plan_);
    other_.reset();
    if (makespanOf(found) < makespanOf(plan_)) return takeElsewhere(std::move(found));
    other_ = std::move(found);
  }

  /// What one round of neighbourhoods makes of a plan, the best one being left alone.
  Plan searchFrom(Plan plan) {
    trimToArrival(plan);
    std::unique_ptr<Incumbent> incumbent;
    const auto workers = employ(incumbent, plan, kForever - 1);
    return runWorkers(*incumbent, workers, nullptr);
  }

  using Workers = std::vector<std::unique_ptr<RefineWorker>>;

  std::uint32_t latestArrival() const {
    return ruleOf(options_.objective).greatest_only ? makespanOf(plan_) : kForever - 1;
  }

  Workers employ(std::unique_ptr<Incumbent>& incumbent, const Plan& plan,
                 std::uint32_t latest_arrival) {
    incumbent = std::make_unique<Incumbent>(plan);
    Workers workers;
    for (std::uint32_t i = 0; i < options_.threads; ++i) {
      const std::uint64_t seed = options_.seed * options_.threads + i;
      workers.push_back(std::make_unique<RefineWorker>(instance_, *incumbent, latest_arrival, seed,
                                                       reserved_.paths()));
    }
    return workers;
  }

  Plan runWorkers(Incumbent& incumbent, const Workers& workers, const Annealing* annealing) {
    const Deadline round = deadline_.within(kRoundSec);
    std::vector<Executor::Job> jobs;
    for (const auto& worker : workers) {
      jobs.push_back({0, [&worker = *worker, &round, annealing] { worker.run(round, annealing); }});
    }
    executor_.run(std::move(jobs), options_.threads, deadline_);
    std::uint64_t seen = incumbent.version();
    for (const auto& worker : workers) seen = std::min(seen, worker->version());
    incumbent.forgetBefore(seen);
    return incumbent.plan();
  }

  const Instance& instance_;
  const RefineOptions options_;
  Executor& executor_;
  const Deadline& deadline_;
  const std::function<void(const Plan&)>& improved_;
  const Annealing annealing_;
  const ReservedPaths reserved_;
  Settlement settlement_;
  Plan plan_;                             // the best
  std::uint64_t cost_;                    // its sum of costs
  std::unique_ptr<Incumbent> incumbent_;  // it, or one that may lead to a better one
  Workers workers_;
  std::optional<Plan> other_;  // one that is worse, but may lead to a better one
  std::uint32_t in_vain_ = 0;  // rounds of neighbourhoods since the last gain
  std::uint32_t turns_ = 0;    // since these began to gain nothing
  std::uint64_t group_rounds_ = 0;
  std::vector<std::string> window_solvers_;
  std::uint64_t window_rounds_ = 0;
  std::uint64_t descents_ = 0;
  std::uint64_t patience_ = kFirstPatience;
  double settling_sec_ = 0;
  double descents_sec_ = 0;
  double search_sec_ = 0;
};

}  // namespace

bool canRefine(Objective objective) {
  switch (objective) {
    case Objective::kMakespan:
    case Objective::kSumOfCosts:
      return true;
  }
  return false;  // there is no other
}

Plan refine(const Instance& instance, Plan plan, const RefineOptions& options, Executor& executor,
            const Deadline& deadline, const std::function<void(const Plan&)>& improved) {
  trimToArrival(plan);
  return Refinement(instance, std::move(plan), options, executor, deadline, improved).run();
}

}  // namespace split_mapf
