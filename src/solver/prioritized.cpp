#include "split_mapf/solver/prioritized.h"

#include <algorithm>
#include <memory>
#include <unordered_set>
#include <utility>
#include <vector>

#include <boost/functional/hash.hpp>

#include "solver/search/robot_order.h"
#include "solver/search/safe_interval_search.h"
#include "split_mapf/core/option_values.h"
#include "split_mapf/core/random.h"

namespace split_mapf {
namespace {

using Order = std::vector<std::uint32_t>;

/// Orders that were tried. Gives up on finding a new one after a while, as few robots have few
/// orders.
class TriedOrders {
 public:
  bool makeNew(Order& order, RandomEngine& engine) {
    constexpr int kMostShuffles = 100;
    for (int i = 0; i < kMostShuffles; ++i) {
      if (hashes_.insert(boost::hash_range(order.begin(), order.end())).second) return true;
      shuffle(order, engine);
    }
    return false;
  }

 private:
  std::unordered_set<std::size_t> hashes_;
};

enum class Attempt { kDone, kBlocked, kInterrupted, kExhausted };

/// Plans all robots in one order; `failed` is the position of the robot that found no path.
Attempt planInOrder(const Instance& instance, const Order& order, const Deadline& deadline,
                    SafeIntervalSearch& search, PathTable& table, std::uint64_t limit,
                    SolveResult& result, std::size_t& failed) {
  table.clear();
  Plan plan;
  plan.paths.resize(instance.robots());
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (deadline.expired()) return Attempt::kInterrupted;
    SearchQuery query;
    query.robot = order[i];
    query.start = instance.start(order[i]);
    query.distances = &instance.distances(order[i]);
    query.others = &table;
    query.mode = OthersAre::kObstacles;
    SearchAnswer answer = search.search(query, deadline);
    result.low_level_expansions += answer.expansions;
    if (answer.interrupted) return Attempt::kInterrupted;
    if (limit > 0 && result.low_level_expansions > limit) return Attempt::kExhausted;
    if (answer.path.empty()) {
      failed = i;
      return Attempt::kBlocked;
    }
    table.insert(order[i], answer.path);
    plan.paths[order[i]] = std::move(answer.path);
  }
  result.plan = std::move(plan);
  return Attempt::kDone;
}

}  // namespace

PrioritizedSolver::PrioritizedSolver(const SolverOptions& options)
    : objective_(options.objective),
      seed_(options.seed),
      expansion_limit_(options.expansion_limit) {
  const OptionValues values(options.values);
  settings_.order = values.choice("order", settings_.order, robotOrders());
  settings_.restarts = values.count("restarts", settings_.restarts);
}

SolverInfo PrioritizedSolver::info() {
  const Settings defaults;
  return {
      "prioritized",
      "prioritised planning with restarts: fast, incomplete",
      {{"order", defaults.order, "shortest_first, longest_first, random or given"},
       {"restarts", std::to_string(defaults.restarts),
        "how often a robot that finds no path may move to the front"}},
      [](const SolverOptions& options) { return std::make_unique<PrioritizedSolver>(options); }};
}

SolveResult PrioritizedSolver::solve(const Instance& instance, const Deadline& deadline) const {
  SolveResult result;
  if (const auto robot = findCutOffRobot(instance)) return cutOffResult(*robot);
  result.lower_bound = lowerBound(instance, objective_);
  RandomEngine engine(seed_);
  SafeIntervalSearch search(instance.graph());
  PathTable table(instance.graph().size());
  TriedOrders tried;
  Order order = makeOrder(instance, settings_.order, engine);
  for (std::uint64_t restart = 0;; ++restart) {
    if (!tried.makeNew(order, engine) || restart > settings_.restarts) {
      result.termination = Termination::kNoPlanFound;
      result.message = "prioritised planning failed in " + std::to_string(restart) +
                       " orders of the robots; it is incomplete: try another solver";
      return result;
    }
    ++result.high_level_nodes;
    std::size_t failed = 0;
    const Attempt attempt =
        planInOrder(instance, order, deadline, search, table, expansion_limit_, result, failed);
    if (attempt == Attempt::kDone) break;
    if (attempt == Attempt::kExhausted) return outOfExpansions(expansion_limit_);
    if (attempt == Attempt::kInterrupted) {
      result.termination = interruptionOf(deadline);
      return result;
    }
    const auto place = order.begin() + static_cast<std::ptrdiff_t>(failed);
    std::rotate(order.begin(), place, place + 1);
  }
  result.termination = Termination::kSolved;
  certifyByLowerBound(result, objective_, "prioritized");
  return result;
}

}  // namespace split_mapf
