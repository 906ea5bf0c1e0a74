#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "solver/ilp/clique_cuts.h"
#include "solver/ilp/conflict_separator.h"
#include "solver/ilp/engine.h"
#include "solver/ilp/master.h"
#include "solver/ilp/node_queue.h"
#include "solver/ilp/penalties.h"
#include "solver/ilp/pricing.h"
#include "solver/ilp/rectangle_cuts.h"
#include "solver/ilp/window.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/objective.h"
#include "split_mapf/core/plan.h"

namespace split_mapf::ilp {

/// Branch and cut and price over the paths of the robots: finds a plan that costs less than a
/// limit, the cheapest for sum of costs, or proves that there is none. The linear programs are
/// GLPK's; the bounds are Lagrangian, computed from exact pricing, so that they hold whatever the
/// duals are. Source: Lam, Le Bodic, Harabor, Stuckey, IJCAI 2019; see docs/ilp.md for what
/// differs.
class BranchAndPrice {
 public:
  /// @param cost_limit  plans that cost this or more are of no interest.
  /// @pre cost_limit > lowerBound(instance, objective); the instance outlives this object.
  BranchAndPrice(const Instance& instance, Objective objective, std::uint64_t cost_limit,
                 const Effort& effort);

  /// What such a search needs at the least, before it is begun [bytes].
  static std::uint64_t leastMemoryBytes(const Instance& instance, Objective objective,
                                        std::uint64_t cost_limit);

  /// Hands paths to begin with. @pre the plan is valid; it may cost more than the limit.
  void suggest(const Plan& plan);
  void setRounding(Rounding rounding) { rounding_ = std::move(rounding); }

  /// @throws GlpkError.
  SearchEnd run();

  /// The best plan below the limit, if one was found.
  const std::optional<Plan>& plan() const { return plan_; }
  /// Every plan that costs less than the limit costs at least this.
  /// @param end  how the search ended.
  std::uint64_t lowerBound(SearchEnd end) const;
  SearchCounts counts() const;

 private:
  enum class Verdict { kPruned, kOpen, kStopped };

  bool makespan() const { return ruleOf(objective_).greatest_only; }
  /// Bounds above this belong to plans of no interest.
  double ceiling() const { return makespan() ? 0.0 : static_cast<double>(cost_limit_) - 1; }
  bool hopeless(double bound) const { return roundUp(bound) > ceiling(); }
  void setCostLimit(std::uint64_t cost_limit);
  void makeWindows();
  /// Bounds each arrival of each robot by the root's duals. @pre the root is under work.
  void boundArrivals();
  void enterNode(std::uint32_t node);
  Verdict processNode(double& bound);
  Verdict solveRelaxation(double& bound);
  double price(std::size_t& added);
  double priceRobot(std::uint32_t robot, std::size_t& added);
  std::optional<Fork> chooseFork(double bound);
  std::size_t cut(const std::vector<UsedPath>& used);
  void round(const std::vector<UsedPath>& used);
  void acceptIntegral(const std::vector<UsedPath>& used);
  void accept(Plan plan);
  bool stopped();

  const Instance& instance_;
  Objective objective_;
  std::uint64_t cost_limit_;
  Effort effort_;
  MoveSpace space_;
  std::vector<Window> windows_;
  std::vector<double> most_costs_;  // by robot: of a path that may matter
  std::vector<std::vector<double>>
      arrival_bounds_;              // by robot, arrival: of plans with that arrival
  double arrivals_bounded_at_ = 0;  // the root's bound when that was found
  Master master_;
  Pricing pricing_;
  Penalties penalties_;
  ConflictSeparator separator_;
  RectangleCuts rectangles_;
  CliqueCuts cliques_;
  NodeQueue tree_;
  Rounding rounding_;
  std::vector<RobotRules> rules_;
  std::optional<Plan> plan_;
  double open_bound_ = 0;         // of the node that is taken but not finished
  std::uint32_t node_depth_ = 0;  // of the node under work
  std::uint64_t proved_ = 0;
  SearchEnd end_ = SearchEnd::kExhausted;
  SearchCounts counts_;
};

}  // namespace split_mapf::ilp
