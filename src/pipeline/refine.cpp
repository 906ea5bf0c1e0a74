#include "pipeline/refine.h"

#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/annealing.h"
#include "pipeline/incumbent.h"
#include "pipeline/refine_worker.h"
#include "pipeline/window_descent.h"
#include "solver/search/placement.h"
#include "solver/search/retiming.h"

namespace split_mapf {
namespace {

// Between rounds the plan is shown, and other callers of the executor get their turn.
constexpr double kRoundSec = 0.2;
// Placements a robot without progress before a descent is given up; doubled each time.
constexpr std::uint64_t kFirstPatience = 5;
// Windows that a plan is cut into, and what a window may take for a unit of patience.
constexpr std::array<std::uint32_t, 4> kWindowCuts = {1, 2, 4, 8};
constexpr std::uint64_t kWindowExpansions = 20000;

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
        plan_(std::move(plan)),
        cost_(sumOfCostsOf(plan_)) {
    if (options.solvers == nullptr) return;
    const std::vector<std::string> known = options.solvers->names();
    for (const char* name : {"ecbs", "ilp"}) {
      if (std::find(known.begin(), known.end(), name) != known.end()) {
        window_solvers_.emplace_back(name);
      }
    }
  }

  Plan run() {
    const std::uint64_t least = sumOfCostsLowerBound(instance_);
    while (!deadline_.expired()) {
      const bool may_descend = mayDescend();
      if (may_descend && descents_sec_ <= search_sec_) {
        timed(descents_sec_, [this] {
          if (!descend()) shortenSomeWindow();
        });
      } else if (cost_ > least) {
        timed(search_sec_, [this] { searchNeighbourhoods(); });
      } else if (may_descend) {
        search_sec_ = descents_sec_;  // nothing else is left to do
      } else {
        break;
      }
    }
    return std::move(plan_);
  }

 private:
  bool mayDescend() const {
    return options_.objective == Objective::kMakespan &&
           makespanOf(plan_) > makespanLowerBound(instance_);
  }

  template <typename Work>
  static void timed(double& seconds, Work work) {
    const auto begin = Deadline::Clock::now();
    work();
    seconds += std::chrono::duration<double>(Deadline::Clock::now() - begin).count();
  }

  void take(Plan plan) {
    plan_ = std::move(plan);
    cost_ = sumOfCostsOf(plan_);
    improved_(plan_);
  }

  /// Each worker tries to make everybody arrive a step earlier; the first to succeed stops the
  /// others.
  bool descend() {
    const auto stop = std::make_shared<StopFlag>(deadline_.stopFlag());
    const Deadline deadline = deadline_.withStop(stop);
    const std::uint32_t horizon = makespanOf(plan_) - 1;
    std::mutex mutex;
    std::optional<Plan> found;
    std::vector<Executor::Job> jobs(options_.threads);
    for (Executor::Job& job : jobs) {
      job.run = [&, seed = ++descents_ + options_.seed] {
        Placement placement(instance_, plan_, horizon, seed);
        Placement::Effort effort;
        effort.patience = patience_ * instance_.robots();
        effort.delayed_one_in = Placement::kDelayedOneIn;
        effort.hasty = true;
        if (placement.run(horizon, effort, deadline) != Placement::Outcome::kDone) return;
        const std::lock_guard<std::mutex> lock(mutex);
        if (!found) found = placement.plan();
        stop->request();
      };
    }
    executor_.run(std::move(jobs), options_.threads, deadline_);
    if (!found) {
      patience_ *= 2;
      return false;
    }
    workers_.clear();
    take(std::move(*found));
    return true;
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
      if (!shorter) continue;
      workers_.clear();
      return take(std::move(*shorter));
    }
  }

  void searchNeighbourhoods() {
    if (workers_.empty()) employWorkers();
    // Between descents there is no telling how much time is left for this.
    const Annealing* const annealing = mayDescend() ? nullptr : &annealing_;
    const Deadline round = deadline_.within(kRoundSec);
    std::vector<Executor::Job> jobs;
    for (const auto& worker : workers_) {
      jobs.push_back({0, [&worker = *worker, &round, annealing] { worker.run(round, annealing); }});
    }
    executor_.run(std::move(jobs), options_.threads, deadline_);
    std::uint64_t seen = incumbent_->version();
    for (const auto& worker : workers_) seen = std::min(seen, worker->version());
    incumbent_->forgetBefore(seen);
    Plan now = incumbent_->plan();
    const std::uint64_t cost = sumOfCostsOf(now);
    if (cost < cost_) {
      take(std::move(now));
    } else if (cost == cost_) {
      plan_ = std::move(now);
    }
  }

  void employWorkers() {
    const std::uint32_t latest =
        options_.objective == Objective::kMakespan ? makespanOf(plan_) : kForever - 1;
    placeWaits(instance_.graph().size(), plan_);
    incumbent_ = std::make_unique<Incumbent>(plan_);
    for (std::uint32_t i = 0; i < options_.threads; ++i) {
      const std::uint64_t seed = options_.seed * options_.threads + i;
      workers_.push_back(std::make_unique<RefineWorker>(instance_, *incumbent_, latest, seed));
    }
  }

  const Instance& instance_;
  const RefineOptions options_;
  Executor& executor_;
  const Deadline& deadline_;
  const std::function<void(const Plan&)>& improved_;
  const Annealing annealing_;
  Plan plan_;                             // the best
  std::uint64_t cost_;                    // its sum of costs
  std::unique_ptr<Incumbent> incumbent_;  // it, or one that may lead to a better one
  std::vector<std::unique_ptr<RefineWorker>> workers_;
  std::vector<std::string> window_solvers_;
  std::uint64_t window_rounds_ = 0;
  std::uint64_t descents_ = 0;
  std::uint64_t patience_ = kFirstPatience;
  double descents_sec_ = 0;
  double search_sec_ = 0;
};

}  // namespace

Plan refine(const Instance& instance, Plan plan, const RefineOptions& options, Executor& executor,
            const Deadline& deadline, const std::function<void(const Plan&)>& improved) {
  trimToArrival(plan);
  return Refinement(instance, std::move(plan), options, executor, deadline, improved).run();
}

}  // namespace split_mapf
