#pragma once

#include <cstdint>

#include <split_mapf/PlanLayout.h>
#include <visualization_msgs/MarkerArray.h>

#include "split_mapf/core/plan_report.h"
#include "split_mapf/ros/planning_grid.h"

namespace split_mapf {

/// Bytes that the owners of the cells may take in a message.
constexpr std::uint64_t kMostLayoutBytes = 64ULL << 20U;

/// The layout of a report's space split as a message; one without phases when there was none, or,
/// with a warning, when its owners would take more than kMostLayoutBytes.
PlanLayout layoutOf(const PlanReport& report, const PlanningGrid& grid, const ros::Time& stamp);

/// Checks a layout message, wherever it comes from. @throws InputError for lists that do not fit
/// each other or the grid. Cost: O(cells).
void requireConsistent(const PlanLayout& layout);

/// Draws a layout for rviz: for each phase N three list markers in namespaces of their own, `phase
/// N regions`, `phase N buffers` and `phase N states`, behind a marker that deletes what was shown
/// before. @throws InputError for a layout whose lists do not fit each other.
visualization_msgs::MarkerArray layoutMarkers(const PlanLayout& layout);

}  // namespace split_mapf
