#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/roadmap/bottleneck.h"
#include "split_mapf/roadmap/map_frame.h"
#include "split_mapf/roadmap/obstacle_raster.h"
#include "split_mapf/roadmap/roadmap.h"

namespace split_mapf {

/// Where one robot stands on a raster and where it is to go.
struct RobotPoses {
  MapPoint start;
  MapPoint goal;
  double radius_m = -1;  ///< at most the planning graph's; negative: the graph's
};

/// Why a robot cannot be brought onto the planning graph, or off it.
enum class AttachmentFaultKind {
  kOutsideMap,
  kTooNearObstacle,  ///< a goal, or a start from which no way leads away from the obstacle
  kDiscsOverlap,     ///< two starts, or two goals, are too near to each other
  kNoVertex,         ///< no vertex within the snap distance by a clear straight leg
  kOtherPiece,       ///< start and goal are near vertices of different pieces of the graph only
  kTaken,            ///< more robots than vertices in their reach
  kCrowd,            ///< legs that no order keeps apart from the other robots
};

/// One robot at fault; `other`, the lengths and the bottleneck mean something where the kind needs
/// them.
struct AttachmentFault {
  std::uint32_t robot = 0;
  AttachmentFaultKind kind = AttachmentFaultKind::kOutsideMap;
  bool at_goal = false;     ///< it is the goal that is at fault, not the start
  MapPoint pose;            ///< the one at fault, on the raster
  std::uint32_t other = 0;  ///< of kDiscsOverlap
  double distance_m = 0;    ///< that there is; of kNoVertex: the snap distance
  double needed_m = 0;      ///< that this robot needs instead
  double ways_need_m = 0;   ///< that edges keep from obstacles, for the largest robot
  /// Of kNoVertex and kOtherPiece, as findBottlenecks() finds it.
  std::optional<Bottleneck> bottleneck;
  /// A narrower bottleneck proves that no way is wide enough for this robot. It is found between
  /// centres of cells, and a disc may pass between them; and a robot that starts nearer to an
  /// obstacle than it needs may stay as near.
  double proof_below_m = 0;
};

/// Whether the fault proves that this robot cannot reach its goal by any graph: its ground itself
/// is cut in two. False where a way might be wide enough by less than 0.71 cells of the map.
bool isCutOff(const AttachmentFault& fault);

/// The fault in one sentence that says distance and need. @param names  of the robots, as the user
/// knows them: "robot 'r1'". @param frame  in which the user knows places.
std::string explain(const AttachmentFault& fault, const std::vector<std::string>& names,
                    const MapFrame& frame);

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
/// of straight legs that keep off obstacles; and puts the legs into waves, so that discs keep both
/// radii plus the clearance apart while others stand at their poses or vertices, or walk in the
/// same wave. Legs that block each other are banned in turn and robots matched anew. A start nearer
/// to an obstacle than radius + clearance is left by legs that never come nearer than it is
/// already.
/// @param snap_distance_m  greatest length of a leg; 0: one spacing of the lattice.
/// Deterministic. Cost: about robots^2; where robots are cut off, O(cells) to say where.
/// Thread-safe.
/// @throws Interrupted when the deadline struck.
Attachment attachRobots(const ObstacleRaster& raster, const Roadmap& roadmap,
                        const std::vector<RobotPoses>& robots, double snap_distance_m = 0,
                        const Deadline& deadline = Deadline());

}  // namespace split_mapf
