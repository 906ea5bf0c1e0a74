#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "split_mapf/core/plan.h"
#include "split_mapf/roadmap/attachment.h"
#include "split_mapf/roadmap/obstacle_raster.h"
#include "split_mapf/roadmap/roadmap.h"

namespace split_mapf {

/// Where one robot's centre is at every whole step, from its start pose to its goal pose; between
/// two steps it goes straight at constant speed, and behind the last one it stays.
using Course = std::vector<MapPoint>;

/// The whole way of every robot: out of its start in its departure wave, along its path of `plan`
/// once all have departed, and into its goal in its arrival wave once all paths have ended.
/// @pre the attachment has no faults; the plan leads from its departure vertices to its arrival
/// vertices. Cost: O(steps of all robots).
std::vector<Course> coursesOf(const Roadmap& roadmap, const std::vector<RobotPoses>& robots,
                              const Attachment& attachment, const Plan& plan);

/// Checks courses in continuous time, by code that shares nothing with what made them: centres keep
/// twice the radius plus the clearance apart and radius + clearance from obstacles. Of a robot that
/// begins nearer to an obstacle than that: it comes no nearer, and keeps the distance once it has
/// it.
/// @return what is wrong first, in one sentence naming robots and step; nothing when all is well.
/// Cost: O(steps * robots^2). Thread-safe.
std::optional<std::string> findMeeting(const ObstacleRaster& raster, const Roadmap& roadmap,
                                       const std::vector<Course>& courses);

}  // namespace split_mapf
