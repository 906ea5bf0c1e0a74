#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pipeline/checked_request.h"
#include "pipeline/run_log.h"
#include "split_mapf/core/way_band.h"
#include "split_mapf/solvability/solvability.h"

namespace split_mapf {

/// A call of Planner::plan() on a huge map: finds the robots' shortest ways, plans on the cells
/// around them and, where there is no plan, on more and more of the map. So a few robots in a large
/// hall take about as long and as much memory as their ways. What is proved on a part of the map is
/// no proof for the whole: its bounds are those of the shortest ways.
class BandRun {
 public:
  BandRun(const Instance& instance, CheckedRequest request, const SolverRegistry& solvers,
          Executor& executor, const Deadline& deadline, const PlanListener& listener);

  /// Whether an instance is planned this way: its map is huge, and nothing is asked for that only
  /// the whole map can give, which are a space split and the bounds of solvers that prove them.
  static bool isFor(const Instance& instance, const CheckedRequest& request,
                    const SolverRegistry& solvers);
  PlanReport run();

 private:
  PlanReport planSomewhere();
  /// Nothing when the cells near the ways do not do.
  std::optional<PlanReport> planNearWays();
  PlanReport planOn(const Instance& part, const PlanListener& listener);
  /// What is said of a plan on the band, said of the map.
  PlanListener listenerOn(const WayBand& band) const;
  void putOnMap(PlanReport& report, const WayBand& band) const;
  void addTimes(PlanReport& report) const;
  PlanReport emptyReport() const;

  const Instance& instance_;
  CheckedRequest request_;
  const SolverRegistry& solvers_;
  Executor& executor_;
  const Deadline& deadline_;
  const PlanListener& listener_;
  RunLog log_;
  double bound_ = 0;      ///< of the objective, from the shortest ways
  double begin_sec_ = 0;  ///< of the part that is planned on
};

}  // namespace split_mapf
