#pragma once

#include <vector>

#include "split_mapf/core/grid.h"
#include "split_mapf/fleet/fleet_report.h"

namespace split_mapf {

/// Where robots are sent, and why some are not sent where they are wanted.
struct FleetGoals {
  std::vector<Vertex> goals;  ///< pairwise different
  std::vector<GoalFault> faults;
};

/// Sends each robot where it is wanted, if there is a way alone; others to the nearest vertex where
/// nobody is wanted or begins. Robots that take no part stay.
/// Whoever stands in the way of a goal and can go nowhere else closes that goal.
/// @param known  faults that are known already. @param open  the grid without ways to blocked
/// vertices. @param starts  pairwise different. @param shunned  by vertex: where no robot without a
/// way is left or sent, if it can go elsewhere; empty: nowhere.
/// @pre wanted goals of robots that take part are pairwise different. Cost: O(vertices) a robot
/// without a way.
FleetGoals chooseGoals(const Grid& open, const std::vector<bool>& blocked,
                       const std::vector<Vertex>& starts, const std::vector<Vertex>& wanted,
                       const std::vector<bool>& takes_part, const std::vector<GoalFault>& known,
                       const std::vector<bool>& shunned = {});

}  // namespace split_mapf
