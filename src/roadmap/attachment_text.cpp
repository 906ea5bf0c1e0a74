#include <string>

#include "split_mapf/roadmap/attachment.h"

namespace split_mapf {
namespace {

/// Where and how much too narrow the widest way is.
std::string wayTo(const AttachmentFault& fault, const MapFrame& frame) {
  if (!fault.bottleneck) return "no free way leads from its start to its goal, however narrow";
  const bool is_small = fault.needed_m < fault.ways_need_m;
  const std::string need =
      inMetres(fault.ways_need_m) + " needed" + (is_small ? " by the largest robot" : "");
  if (fault.bottleneck->distance_m < fault.ways_need_m) {
    return "the widest way from its start to its goal has " +
           inMetres(fault.bottleneck->distance_m) + " to an obstacle at " +
           describe(frame, fault.bottleneck->place) + ", " + need;
  }
  return "the map has a way that is wide enough (" + need +
         "), but the planning graph does not follow it";
}

std::string reasonOf(const AttachmentFault& fault, const std::vector<std::string>& names,
                     const MapFrame& frame) {
  const std::string need = inMetres(fault.needed_m) + " are needed";
  switch (fault.kind) {
    case AttachmentFaultKind::kOutsideMap:
      return "lies outside the map";
    case AttachmentFaultKind::kTooNearObstacle:
      return "is " + inMetres(fault.distance_m) + " from an obstacle, " + need;
    case AttachmentFaultKind::kDiscsOverlap:
      return "is " + inMetres(fault.distance_m) + " from that of " + names[fault.other] + ", " +
             need;
    case AttachmentFaultKind::kNoVertex:
      return "has no clear straight way of at most " + inMetres(fault.distance_m) +
             " (snap_distance) to a vertex of the planning graph; " + wayTo(fault, frame);
    case AttachmentFaultKind::kOtherPiece:
      return "is near no vertex to which edges lead from those near its start; " +
             wayTo(fault, frame);
    case AttachmentFaultKind::kTaken:
      return "has no vertex within " + inMetres(fault.distance_m) +
             " (snap_distance) that other robots leave to it";
    case AttachmentFaultKind::kCrowd:
      break;
  }
  return "is hemmed in by other robots: no order of legs keeps them apart";
}

}  // namespace

bool isCutOff(const AttachmentFault& fault) {
  if (fault.kind != AttachmentFaultKind::kNoVertex &&
      fault.kind != AttachmentFaultKind::kOtherPiece) {
    return false;
  }
  return !fault.bottleneck || fault.bottleneck->distance_m < fault.proof_below_m;
}

std::string explain(const AttachmentFault& fault, const std::vector<std::string>& names,
                    const MapFrame& frame) {
  return names[fault.robot] + ": its " + (fault.at_goal ? "goal " : "start ") +
         describe(frame, fault.pose) + " " + reasonOf(fault, names, frame);
}

}  // namespace split_mapf
