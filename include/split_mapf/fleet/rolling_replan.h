#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/fleet_check.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/fleet/fleet_replan.h"
#include "split_mapf/pipeline/rolling.h"

namespace split_mapf {

/// Answers the questions of a rolling fleet (FleetOptions::rolling), one after the other: plans a
/// window of steps behind what is promised, where robots are expected to be free, on the cells that
/// are open. What robots were going to do is the warm start. Where robots do not begin together,
/// rotations are planned away, and what still would wait for one is left out: so whatever an answer
/// holds can be carried out, and robots stop at its end unless another one comes.
///
/// On a planning graph the same holds. Edges that come too near to robots that take no part are
/// left out of the graph; who has stood for long begins to count anew when these change.
///
/// The same questions give the same answers at any thread count, as long as no deadline expires.
/// Not thread-safe. Cost: that of Rolling, and O(visits).
class RollingReplanner {
 public:
  /// @param options  of the windows. @throws OptionError, InputError as Rolling.
  RollingReplanner(std::shared_ptr<const Grid> grid, const RollingOptions& options);

  /// @param deadline  ends the search for a better window, not before a share of it is done.
  /// @throws std::logic_error when what was found is not valid, which would be a bug.
  FleetAnswer answer(const FleetQuestion& question, const Deadline& deadline);

  std::uint32_t window() const { return options_.window; }

 private:
  void ask(const FleetQuestion& question);
  RollingAnswer search(const FleetQuestion& question, const Deadline& deadline);
  Plan withoutRotations(const FleetQuestion& question, Plan plan, const Deadline& deadline);
  void requireValid(const Plan& plan);
  std::vector<GoalFault> faultsOf(const FleetQuestion& question, const RollingAnswer& found) const;
  void closeEdges(const std::vector<Edge>& closed);
  const std::shared_ptr<const Grid>& openGrid(const std::vector<bool>& blocked);

  std::shared_ptr<const Grid> grid_;
  RollingOptions options_;
  std::unique_ptr<Rolling> rolling_;
  std::vector<Edge> closed_edges_;  ///< that its graph lacks
  FleetChecker checker_;
  RollingQuestion question_;
  double begun_sec_ = 0;  ///< when the step began that the last question was asked in
  bool has_begun_ = false;
  std::uint32_t steps_over_ = 0;
  std::vector<bool> open_blocked_;  ///< what the open grid lacks
  std::shared_ptr<const Grid> open_;
};

}  // namespace split_mapf
