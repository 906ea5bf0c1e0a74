#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "split_mapf/roadmap/obstacle_raster.h"
#include "split_mapf/roadmap/roadmap.h"

namespace split_mapf {

/// A place on a map [m], from the corner of its first cell: x along rows, y along columns.
struct MapPoint {
  double x = 0;
  double y = 0;
};

/// Where one robot stands and where it is to go.
struct RobotPoses {
  MapPoint start;
  MapPoint goal;
};

/// Why a robot cannot be brought onto the planning graph, or off it.
enum class AttachmentFaultKind {
  kOutsideMap,
  kTooNearObstacle,  ///< a goal, or a start from which no way leads away from the obstacle
  kDiscsOverlap,     ///< two starts, or two goals, are too near to each other
  kNoVertex,         ///< no vertex that is left within the snap distance by a clear straight leg
  kOtherPiece,       ///< start and goal are near vertices of different pieces of the graph only
  kCrowd,            ///< legs that no order keeps apart from the other robots
};

/// One robot at fault. The message says distance and need.
struct AttachmentFault {
  std::uint32_t robot = 0;
  AttachmentFaultKind kind = AttachmentFaultKind::kOutsideMap;
  std::string message;
};

/// The straight ways between poses and vertices, each robot's in one whole step.
struct Legs {
  std::vector<Vertex> vertices;      ///< a robot, all different
  std::vector<std::uint32_t> waves;  ///< a robot: in which step its leg is walked, from 0 on
  std::uint32_t steps = 0;           ///< number of waves; a wave of no length needs none
};

/// How robots that stand anywhere get onto a planning graph and off it.
struct Attachment {
  Legs departure;  ///< from the starts
  Legs arrival;    ///< to the goals
  std::vector<AttachmentFault>
      faults;  ///< every robot at fault; the legs mean nothing unless empty
};

/// Gives every robot a vertex to start from and one to end at, by the least sum of squared lengths
/// of straight legs that keep off obstacles; and puts the legs into waves, so that discs keep twice
/// the radius plus the clearance apart while others stand at their poses or vertices, or walk in
/// the same wave. Legs that block each other are banned in turn and robots matched anew. A start
/// nearer to an obstacle than radius + clearance is left by legs that never come nearer than it is
/// already.
/// @param snap_distance_m  greatest length of a leg; 0: one spacing of the lattice.
/// Deterministic. Cost: about robots^2. Thread-safe.
Attachment attachRobots(const ObstacleRaster& raster, const Roadmap& roadmap,
                        const std::vector<RobotPoses>& robots, double snap_distance_m = 0);

}  // namespace split_mapf
