#pragma once

#include <string>
#include <vector>

#include <split_mapf/RobotFault.h>

#include "split_mapf/ros/planning_grid.h"
#include "split_mapf/solvability/solvability.h"

namespace split_mapf {

/// A proof that no plan exists, as users of ROS see robots and cells: ids, y up, and metres.
struct UnsolvableAnswer {
  std::string message;             ///< the first obstacle, and how many there are
  std::vector<RobotFault> faults;  ///< every robot that an obstacle concerns, in the goal's order
};

/// @pre verdicts is not empty, and all are refusals.
UnsolvableAnswer describeUnsolvable(const std::vector<SolvabilityVerdict>& verdicts,
                                    const std::vector<std::string>& ids, const PlanningGrid& grid);

}  // namespace split_mapf
