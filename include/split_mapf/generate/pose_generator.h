#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/roadmap/attachment.h"
#include "split_mapf/roadmap/obstacle_raster.h"
#include "split_mapf/roadmap/roadmap.h"

namespace split_mapf {

/// What random poses are drawn for.
struct PoseDraw {
  std::shared_ptr<const ObstacleRaster> raster;
  RoadmapOptions roadmap;
  double snap_distance_m = 0;
  std::uint32_t robots = 10;
  std::uint64_t seed = 0;
};

/// Random poses, and how many draws were not fit.
struct DrawnPoses {
  std::vector<RobotPoses> robots;
  std::vector<double> start_yaws_rad;  ///< -pi .. pi
  std::vector<double> goal_yaws_rad;
  /// Robots that were drawn and cannot be attached to the planning graph: others took their place.
  std::uint32_t left_out = 0;
};

/// Draws starts and goals, uniformly from the ground on which a disc fits, kSparePoseM more than
/// the discs need apart, and such that all robots can be brought onto the planning graph at once.
/// The same draw gives the same poses everywhere.
/// @throws OptionError as buildRoadmap(), and when the map does not hold so many robots;
/// Interrupted. Cost: that of the graph, and of attaching the robots a few times.
DrawnPoses drawPoses(const PoseDraw& draw, const Deadline& deadline = Deadline());

constexpr double kSparePoseM = 0.02;

}  // namespace split_mapf
