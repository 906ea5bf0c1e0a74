#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "solver/ilp/conflict_row.h"
#include "solver/search/path_table.h"
#include "solver/search/safe_interval_search.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/random.h"

namespace split_mapf::ilp {

/// Makes good upper bounds for the sum of costs: improves a plan by taking a few robots out and
/// planning them anew among the others (large-neighbourhood search; Li et al., IJCAI 2021), and
/// completes what a fractional solution suggests. Deterministic but for the deadline. Not
/// thread-safe.
class PlanImprover {
 public:
  /// @pre the instance outlives this object.
  PlanImprover(const Instance& instance, std::uint64_t seed);

  /// Improves until `patience` neighbourhoods in a row have changed nothing, `floor` is reached, or
  /// the deadline comes.
  Plan improve(Plan plan, std::uint64_t floor, std::uint64_t patience, const Deadline& deadline);
  /// Every robot on its most used path where that is free, else on the earliest that is left, the
  /// most certain robots first. Nothing when a robot finds none or cannot arrive in time.
  std::optional<Plan> complete(const std::vector<UsedPath>& used, std::uint32_t latest_arrival,
                               const Deadline& deadline);
  std::uint64_t expansions() const { return expansions_; }

 private:
  using Robots = std::vector<std::uint32_t>;

  Path planAmongOthers(std::uint32_t robot, std::uint32_t latest_arrival, const Deadline& deadline);
  bool isFree(std::uint32_t robot, const Path& path) const;
  Robots chooseNeighbourhood(const Plan& plan);
  std::uint32_t chooseDelayed(const Plan& plan);
  void addInTheWay(const Plan& plan, std::uint32_t robot, std::size_t most, Robots& robots);
  void addAround(Vertex centre, std::size_t most, Robots& robots);
  bool add(std::uint32_t robot, Robots& robots) const;
  void addVisitors(Vertex v, std::uint32_t t, std::size_t most, Robots& robots) const;
  bool replan(const Robots& robots, Plan& plan, const Deadline& deadline);

  const Instance& instance_;
  RandomEngine engine_;
  SafeIntervalSearch search_;
  PathTable table_;
  std::uint64_t expansions_ = 0;
};

}  // namespace split_mapf::ilp
