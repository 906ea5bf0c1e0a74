#include "solver/ilp/branch_and_price.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "split_mapf/core/validate.h"
#include "split_mapf/solver/solver.h"

namespace split_mapf::ilp {
namespace {

// What a path has to save to be worth a column.
constexpr double kWorthwhile = 1e-6;
constexpr double kNone = 1e-6;
// What the root's bound has to gain before its duals are used again to bound the arrivals.
constexpr double kWorthBounding = 0.5;
// Forks of either kind that are tried before one is taken.
constexpr std::size_t kProbes = 4;
constexpr double kLeastGain = 1e-3;
// Cuts that are added at once.
constexpr std::size_t kMostCuts = 40;

/// Steps that a robot may take at the most in a plan that costs less than the limit.
std::uint32_t latestArrival(const Instance& instance, Objective objective, std::uint64_t cost_limit,
                            std::uint32_t robot) {
  if (ruleOf(objective).greatest_only) return static_cast<std::uint32_t>(cost_limit - 1);
  const std::uint64_t slack = cost_limit - 1 - sumOfCostsLowerBound(instance);
  return instance.shortestLength(robot) + static_cast<std::uint32_t>(slack);
}

std::uint32_t horizonOf(const Instance& instance, Objective objective, std::uint64_t cost_limit) {
  std::uint32_t horizon = 0;
  for (std::uint32_t i = 0; i < instance.robots(); ++i) {
    horizon = std::max(horizon, latestArrival(instance, objective, cost_limit, i));
  }
  return horizon;
}

std::vector<double> artificialCosts(const Instance& instance, Objective objective,
                                    std::uint64_t cost_limit) {
  std::vector<double> costs(instance.robots(), 1);
  if (ruleOf(objective).greatest_only) return costs;
  for (std::uint32_t i = 0; i < instance.robots(); ++i) {
    costs[i] = latestArrival(instance, objective, cost_limit, i) + 1.0;
  }
  return costs;
}

}  // namespace

BranchAndPrice::BranchAndPrice(const Instance& instance, Objective objective,
                               std::uint64_t cost_limit, const Effort& effort)
    : instance_(instance),
      objective_(objective),
      cost_limit_(cost_limit),
      effort_(effort),
      space_(instance.graph(), horizonOf(instance, objective, cost_limit)),
      master_(space_, artificialCosts(instance, objective, cost_limit), effort.deadline,
              effort.memory_mb),
      pricing_(space_, objective),
      penalties_(space_, instance.robots()),
      separator_(space_),
      rectangles_(instance, space_),
      cliques_(space_),
      tree_(makespan() ? 0.0 : static_cast<double>(sumOfCostsLowerBound(instance))),
      proved_(split_mapf::lowerBound(instance, objective)) {
  setCostLimit(cost_limit);
}

std::uint64_t BranchAndPrice::leastMemoryBytes(const Instance& instance, Objective objective,
                                               std::uint64_t cost_limit) {
  const std::uint32_t horizon = horizonOf(instance, objective, cost_limit);
  const std::uint64_t moves = MoveSpace::count(instance.graph(), horizon);
  // Penalties and use of every move, use of every vertex, a window a robot.
  constexpr std::uint64_t kBytesAMove = 2 * sizeof(double) + 2;
  std::uint64_t window_vertices = 0;
  for (std::uint32_t i = 0; i < instance.robots(); ++i) {
    const std::uint64_t reach = latestArrival(instance, objective, cost_limit, i);
    window_vertices +=
        std::min<std::uint64_t>(instance.graph().size(), 2 * reach * (reach + 1) + 1);
  }
  constexpr std::uint64_t kBytesAWindowVertex = 32;
  return moves * kBytesAMove + window_vertices * kBytesAWindowVertex;
}

void BranchAndPrice::setCostLimit(std::uint64_t cost_limit) {
  cost_limit_ = cost_limit;
  if (cost_limit <= split_mapf::lowerBound(instance_, objective_)) return;  // nothing is left
  makeWindows();
}

void BranchAndPrice::makeWindows() {
  windows_.clear();
  most_costs_.assign(instance_.robots(), 0);
  for (std::uint32_t i = 0; i < instance_.robots(); ++i) {
    std::uint32_t latest = latestArrival(instance_, objective_, cost_limit_, i);
    if (!arrival_bounds_.empty()) {
      const std::vector<double>& bounds = arrival_bounds_[i];
      latest = std::min(latest, static_cast<std::uint32_t>(bounds.size()) - 1);
      while (latest > instance_.shortestLength(i) && hopeless(bounds[latest])) --latest;
    }
    windows_.emplace_back(instance_, i, latest, space_.slots());
    if (!makespan()) most_costs_[i] = latest;
  }
}

void BranchAndPrice::boundArrivals() {
  double bound = -master_.writePenalties(penalties_);
  std::vector<std::vector<double>> costs(instance_.robots());
  std::vector<double> least(instance_.robots());
  for (std::uint32_t i = 0; i < instance_.robots(); ++i) {
    if (effort_.deadline.expired()) return;
    penalties_.cover(i, rules_[i]);
    least[i] = pricing_.run(windows_[i], penalties_.data(), rules_[i]);
    penalties_.uncover();
    costs[i] = pricing_.costOfArrival();
    bound += least[i];
  }
  for (std::uint32_t i = 0; i < instance_.robots(); ++i) {
    for (double& cost : costs[i]) cost += bound - least[i];
  }
  arrival_bounds_ = std::move(costs);
  arrivals_bounded_at_ = bound;
  makeWindows();
}

void BranchAndPrice::suggest(const Plan& plan) {
  for (std::uint32_t i = 0; i < instance_.robots(); ++i) {
    Path path = plan.paths[i];
    path.resize(costOf(path) + 1);
    if (path.size() > windows_[i].latestArrival() + std::size_t{1}) continue;
    if (makespan()) path.resize(space_.horizon() + std::size_t{1}, path.back());
    master_.addColumn(i, path, makespan() ? 0.0 : static_cast<double>(path.size()) - 1);
  }
}

SearchEnd BranchAndPrice::run() {
  while (!tree_.empty() && !hopeless(tree_.leastBound()) && !(makespan() && plan_)) {
    const std::uint32_t node = tree_.take();
    open_bound_ = tree_.node(node).bound;
    double bound = tree_.node(node).bound;
    node_depth_ = tree_.node(node).depth;
    enterNode(node);
    ++counts_.nodes;
    const Verdict verdict = processNode(bound);
    if (verdict == Verdict::kStopped) {
      open_bound_ = bound;
      break;
    }
    if (verdict == Verdict::kPruned) continue;
    const std::optional<Fork> fork = chooseFork(bound);
    if (!fork) {
      open_bound_ = bound;
      end_ = SearchEnd::kInterrupted;
      break;
    }
    tree_.open(node, fork->first, bound);
    tree_.open(node, fork->second, bound);
    master_.purge(ceiling() - bound + 1);
  }
  return end_;
}

SearchCounts BranchAndPrice::counts() const {
  SearchCounts counts = counts_;
  counts.expansions = pricing_.expansions() + master_.work();
  return counts;
}

/// Tries the most doubtful forks and takes the one that raises the bounds of both children most.
/// Nothing when interrupted.
std::optional<Fork> BranchAndPrice::chooseFork(double bound) {
  // For makespan a dive finds a plan sooner than a careful choice does.
  const std::size_t most_forks = makespan() ? 1 : kProbes;
  const std::vector<Fork> forks = chooseForks(master_.usedPaths(), !makespan(), most_forks);
  if (forks.empty()) {
    throw GlpkError(GlpkError::Kind::kFailure, "a fractional solution without a choice in it");
  }
  if (forks.size() == 1) return forks.front();
  const double most = ceiling() + 1 - bound;  // that much prunes
  std::optional<Fork> best;
  double best_score = -1;
  for (const Fork& fork : forks) {
    const std::optional<double> first = master_.probe(fork.first, instance_);
    if (!first) return std::nullopt;
    const std::optional<double> second = master_.probe(fork.second, instance_);
    if (!second) return std::nullopt;
    const double gain = std::clamp(*first - bound, 0.0, most);
    const double other = std::clamp(*second - bound, 0.0, most);
    const double score = std::max(gain, kLeastGain) * std::max(other, kLeastGain);
    if (score <= best_score) continue;
    best_score = score;
    best = fork;
  }
  return best;
}

std::uint64_t BranchAndPrice::lowerBound(SearchEnd end) const {
  if (makespan()) return end == SearchEnd::kExhausted && !plan_ ? cost_limit_ : proved_;
  double bound = static_cast<double>(cost_limit_);
  if (!tree_.empty()) bound = std::min(bound, tree_.leastBound());
  if (end != SearchEnd::kExhausted) bound = std::min(bound, roundUp(open_bound_));
  return std::max(proved_, static_cast<std::uint64_t>(bound));
}

bool BranchAndPrice::stopped() {
  if (effort_.deadline.expired()) {
    end_ = SearchEnd::kInterrupted;
  } else if (effort_.expansions > 0 && counts().expansions > effort_.expansions) {
    end_ = SearchEnd::kEffort;
  } else if (master_.memoryBytes() + tree_.memoryBytes() > effort_.memory_mb * kBytesAMegabyte) {
    end_ = SearchEnd::kMemory;
  }
  return end_ != SearchEnd::kExhausted;
}

void BranchAndPrice::enterNode(std::uint32_t node) {
  tree_.gather(node, instance_, rules_);
  master_.allowOnly(rules_, most_costs_);
}

/// Solves the node's relaxation, cuts and all. kOpen: what is left is fractional.
BranchAndPrice::Verdict BranchAndPrice::processNode(double& bound) {
  while (true) {
    const Verdict verdict = solveRelaxation(bound);
    if (verdict != Verdict::kOpen) return verdict;
    if (!makespan() && node_depth_ == 0 && bound > arrivals_bounded_at_ + kWorthBounding) {
      boundArrivals();
    }
    const std::vector<UsedPath> used = master_.usedPaths();
    if (cut(used) > 0) continue;
    if (master_.artificialUse() < kNone && !isUndecided(used, !makespan())) {
      acceptIntegral(used);
      return Verdict::kPruned;
    }
    round(used);
    const bool done = (makespan() && plan_) || hopeless(bound);
    return done ? Verdict::kPruned : Verdict::kOpen;
  }
}

/// Column generation until no path is worth a column, or until more cannot raise the bound to the
/// next whole step.
BranchAndPrice::Verdict BranchAndPrice::solveRelaxation(double& bound) {
  while (true) {
    const LpStatus status = master_.solve();
    ++counts_.linear_programs;
    counts_.columns = std::max<std::uint64_t>(counts_.columns, master_.columns());
    counts_.rows = std::max<std::uint64_t>(counts_.rows, master_.conflictRows());
    if (status == LpStatus::kInterrupted) {
      end_ = SearchEnd::kInterrupted;
      return Verdict::kStopped;
    }
    if (status == LpStatus::kInfeasible) {
      throw GlpkError(GlpkError::Kind::kFailure, "GLPK finds a program infeasible that is not");
    }
    std::size_t added = 0;
    bound = std::max(bound, price(added));
    if (hopeless(bound)) return Verdict::kPruned;
    if (stopped()) return Verdict::kStopped;
    if (added == 0) return Verdict::kOpen;
    const bool settled = roundUp(master_.objective()) <= roundUp(bound);
    if (settled && master_.artificialUse() < kNone) return Verdict::kOpen;
  }
}

/// Adds each robot's cheapest path where it is worth it. Returns the Lagrangian bound.
double BranchAndPrice::price(std::size_t& added) {
  double bound = -master_.writePenalties(penalties_);
  for (std::uint32_t i = 0; i < instance_.robots(); ++i) {
    if (effort_.deadline.expired()) return -std::numeric_limits<double>::infinity();
    bound += priceRobot(i, added);
  }
  return bound;
}

double BranchAndPrice::priceRobot(std::uint32_t robot, std::size_t& added) {
  const double dual = master_.robotDual(robot);
  const RobotRules& rules = rules_[robot];
  const double least =
      makespan() ? 0.0 : std::max(instance_.shortestLength(robot), rules.earliest_arrival);
  // No path can be cheaper than its dual asks for.
  if (dual <= least + kWorthwhile) return least;
  penalties_.cover(robot, rules);
  const double cost = pricing_.run(windows_[robot], penalties_.data(), rules);
  penalties_.uncover();
  if (cost >= dual - kWorthwhile) return cost;
  const std::vector<double>& costs = pricing_.costOfArrival();
  const auto arrival =
      static_cast<std::uint32_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
  if (master_.addColumn(robot, pricing_.path(arrival), makespan() ? 0.0 : arrival)) ++added;
  return cost;
}

std::size_t BranchAndPrice::cut(const std::vector<UsedPath>& used) {
  std::vector<ConflictRow> rows;
  separator_.find(used, rows);
  // For makespan a dive through conflict rows alone is faster, and proofs are few.
  if (rows.empty() && !makespan()) {
    rectangles_.find(used, kMostCuts, rows);
    cliques_.find(used, kMostCuts, rows);
  }
  const std::size_t count = rows.size();
  for (ConflictRow& row : rows) master_.addRow(std::move(row));
  return count;
}

void BranchAndPrice::round(const std::vector<UsedPath>& used) {
  if (!rounding_) return;
  if (std::optional<Plan> plan = rounding_(used, cost_limit_)) accept(std::move(*plan));
}

void BranchAndPrice::acceptIntegral(const std::vector<UsedPath>& used) {
  Plan plan;
  plan.paths.resize(instance_.robots());
  for (const UsedPath& path : used) {
    if (path.value > 0.5) plan.paths[path.robot] = *path.path;
  }
  accept(std::move(plan));
}

void BranchAndPrice::accept(Plan plan) {
  if (!validate(instance_, plan).empty()) {
    throw GlpkError(GlpkError::Kind::kFailure, "an integral solution with conflicts in it");
  }
  trimToArrival(plan);
  const std::uint64_t cost = costOf(plan, objective_);
  if (cost >= cost_limit_) return;
  plan_ = std::move(plan);
  setCostLimit(cost);
}

}  // namespace split_mapf::ilp
