#include "split_mapf/roadmap/attachment.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "roadmap/clear_space.h"
#include "roadmap/leg_matching.h"
#include "roadmap/leg_waves.h"
#include "roadmap/vertex_finder.h"
#include "split_mapf/core/graph.h"

namespace split_mapf {
namespace {

using roadmap::Leg;
using roadmap::LegOption;
using roadmap::LegWaves;
using roadmap::Place;
using roadmap::VertexFinder;

constexpr double kTouchM = 1e-6;
// Robots without size may not stand inside an obstacle either [cells].
constexpr double kLeastNeed = 1e-3;
// From a place in a cell to the cell's centre at most, rounded up [cells].
constexpr double kHalfDiagonal = 0.7072;

/// All starts, or all goals.
struct Side {
  bool is_goals;
  std::vector<MapPoint> poses;
  std::vector<std::vector<LegOption>> options;
};

class Attacher {
 public:
  Attacher(const ObstacleRaster& raster, const Roadmap& roadmap,
           const std::vector<RobotPoses>& robots, double snap_distance_m, const Deadline& deadline)
      : raster_(raster),
        roadmap_(roadmap),
        robots_(robots),
        deadline_(deadline),
        finder_(roadmap),
        snap_(snap_distance_m > 0 ? snap_distance_m / raster.resolution_m
                                  : static_cast<double>(roadmap.spacing_cells)) {}

  Attachment run() {
    Side starts{false, {}, {}};
    Side goals{true, {}, {}};
    for (const RobotPoses& robot : robots_) {
      starts.poses.push_back(robot.start);
      goals.poses.push_back(robot.goal);
    }
    findOptions(starts);
    findOptions(goals);
    findOverlaps(starts);
    findOverlaps(goals);
    if (result_.faults.empty()) requireVertices(starts);
    if (result_.faults.empty()) keepToOnePiece(starts, goals);
    if (result_.faults.empty()) result_.departure = matchAndOrder(starts);
    if (result_.faults.empty()) result_.arrival = matchAndOrder(goals);
    // Arriving is leaving the goals, played backwards.
    const std::uint32_t last = std::max(1U, result_.arrival.steps) - 1;
    for (std::uint32_t& wave : result_.arrival.waves) wave = last - wave;
    std::stable_sort(
        result_.faults.begin(), result_.faults.end(),
        [](const AttachmentFault& a, const AttachmentFault& b) { return a.robot < b.robot; });
    addBottlenecks();
    return std::move(result_);
  }

 private:
  double radiusOf(std::uint32_t robot) const {
    return robots_[robot].radius_m < 0 ? roadmap_.robot_radius_m : robots_[robot].radius_m;
  }
  double needOf(std::uint32_t robot) const { return radiusOf(robot) + roadmap_.clearance_m; }

  AttachmentFault& report(std::uint32_t robot, AttachmentFaultKind kind, const Side& side) {
    AttachmentFault fault;
    fault.robot = robot;
    fault.kind = kind;
    fault.at_goal = side.is_goals;
    fault.pose = side.poses[robot];
    fault.distance_m = snap_ * raster_.resolution_m;
    fault.needed_m = needOf(robot);
    fault.ways_need_m = roadmap_.robot_radius_m + roadmap_.clearance_m;
    return result_.faults.emplace_back(fault);
  }

  Place toCells(MapPoint p) const {
    return {p.x / raster_.resolution_m - 0.5, p.y / raster_.resolution_m - 0.5};
  }

  bool isOnMap(Place pose) const {
    return pose.x >= -0.5 && pose.y >= -0.5 && pose.x <= raster_.width - 0.5 &&
           pose.y <= raster_.height - 0.5;
  }

  /// Starts may be too near to an obstacle, where a leg leads away from it.
  void findOptions(Side& side) {
    side.options.resize(side.poses.size());
    const double touch = kTouchM / raster_.resolution_m;
    for (std::uint32_t robot = 0; robot < side.poses.size(); ++robot) {
      deadline_.require();
      const Place pose = toCells(side.poses[robot]);
      if (!isOnMap(pose)) {
        report(robot, AttachmentFaultKind::kOutsideMap, side);
        continue;
      }
      const double need = std::max(kLeastNeed, needOf(robot) / raster_.resolution_m);
      const double room = leastDistance(raster_, pose, pose, need);
      const bool fits = room >= need - touch;
      if (fits || (!side.is_goals && room > 0)) {
        for (const Vertex v : finder_.near(pose, snap_ + touch)) {
          const Place to = finder_.placeOf(v);
          if (leastDistance(raster_, pose, to, room) < room - touch) continue;
          const double dx = to.x - pose.x;
          const double dy = to.y - pose.y;
          side.options[robot].push_back({v, dx * dx + dy * dy, false});
        }
      }
      if (!side.options[robot].empty()) continue;
      if (fits) {
        report(robot, AttachmentFaultKind::kNoVertex, side);
      } else {
        report(robot, AttachmentFaultKind::kTooNearObstacle, side).distance_m =
            room * raster_.resolution_m;
      }
    }
  }

  void findOverlaps(const Side& side) {
    for (std::uint32_t i = 0; i < side.poses.size(); ++i) {
      deadline_.require();
      for (std::uint32_t j = 0; j < i; ++j) {
        const double need = radiusOf(i) + needOf(j);
        const double gap =
            std::hypot(side.poses[i].x - side.poses[j].x, side.poses[i].y - side.poses[j].y);
        if (!(gap < need - kTouchM)) continue;  // or no number, which is reported already
        AttachmentFault& fault = report(i, AttachmentFaultKind::kDiscsOverlap, side);
        fault.other = j;
        fault.distance_m = gap;
        fault.needed_m = need;
        break;
      }
    }
  }

  void requireVertices(const Side& starts) {
    for (std::size_t robot = roadmap_.cells.size(); robot < robots_.size(); ++robot) {
      report(static_cast<std::uint32_t>(robot), AttachmentFaultKind::kTaken, starts);
    }
  }

  /// Of the pieces near both ends of a robot's way it takes the largest.
  void keepToOnePiece(Side& starts, Side& goals) {
    for (std::uint32_t robot = 0; robot < starts.poses.size(); ++robot) {
      Vertex best = kNoVertex;
      for (const LegOption& from : starts.options[robot]) {
        for (const LegOption& to : goals.options[robot]) {
          const Vertex piece = finder_.pieceOf(from.vertex);
          if (piece != finder_.pieceOf(to.vertex)) continue;
          if (best == kNoVertex || finder_.sizeOf(piece) > finder_.sizeOf(best)) best = piece;
        }
      }
      if (best == kNoVertex) {
        report(robot, AttachmentFaultKind::kOtherPiece, goals);
        continue;
      }
      for (Side* side : {&starts, &goals}) {
        std::vector<LegOption>& options = side->options[robot];
        options.erase(std::remove_if(options.begin(), options.end(),
                                     [&](const LegOption& option) {
                                       return finder_.pieceOf(option.vertex) != best;
                                     }),
                      options.end());
      }
    }
  }

  Legs matchAndOrder(Side& side) {
    constexpr int kMostTries = 100;
    LegWaves waves;
    for (int tries = 0; tries < kMostTries; ++tries) {
      Legs legs;
      legs.vertices = roadmap::matchLegs(side.options);
      for (std::uint32_t robot = 0; robot < legs.vertices.size(); ++robot) {
        if (legs.vertices[robot] == kNoVertex) report(robot, AttachmentFaultKind::kTaken, side);
      }
      if (!result_.faults.empty()) return legs;
      const std::vector<Leg> ways = waysOf(side, legs.vertices);
      waves = roadmap::planWaves(ways, roadmap_.clearance_m / raster_.resolution_m, deadline_);
      if (waves.stuck.empty()) {
        const bool any = std::any_of(ways.begin(), ways.end(), [](const Leg& leg) {
          return std::hypot(leg.to.x - leg.from.x, leg.to.y - leg.from.y) > kTouchM;
        });
        legs.waves = waves.waves;
        legs.steps = any ? waves.count : 0;
        if (!any) legs.waves.assign(legs.waves.size(), 0);
        return legs;
      }
      if (!banLegOf(waves.stuck, legs.vertices, side)) break;
    }
    for (const std::uint32_t robot : waves.stuck) {
      report(robot, AttachmentFaultKind::kCrowd, side);
    }
    return {};
  }

  std::vector<Leg> waysOf(const Side& side, const std::vector<Vertex>& vertices) const {
    std::vector<Leg> ways;
    for (std::uint32_t robot = 0; robot < vertices.size(); ++robot) {
      ways.push_back({toCells(side.poses[robot]), finder_.placeOf(vertices[robot]),
                      radiusOf(robot) / raster_.resolution_m});
    }
    return ways;
  }

  /// Forbids the leg of the first stuck robot that has another one. @return whether there was one
  static bool banLegOf(const std::vector<std::uint32_t>& stuck, const std::vector<Vertex>& taken,
                       Side& side) {
    for (const std::uint32_t robot : stuck) {
      std::vector<LegOption>& options = side.options[robot];
      const auto left = std::count_if(options.begin(), options.end(),
                                      [](const LegOption& option) { return !option.banned; });
      if (left < 2) continue;
      for (LegOption& option : options) {
        option.banned = option.banned || option.vertex == taken[robot];
      }
      return true;
    }
    return false;
  }

  /// What a robot keeps from obstacles wherever it goes [m]: its need, or what its start has.
  double leastOnTheWay(std::uint32_t robot) const {
    const double need = std::max(kLeastNeed, needOf(robot) / raster_.resolution_m);
    const Place start = toCells(robots_[robot].start);
    if (!isOnMap(start)) return 0;
    return leastDistance(raster_, start, start, need) * raster_.resolution_m;
  }

  void addBottlenecks() {
    std::vector<std::pair<MapPoint, MapPoint>> ways;
    std::vector<AttachmentFault*> of_ways;
    const double need = roadmap_.robot_radius_m + roadmap_.clearance_m;
    for (AttachmentFault& fault : result_.faults) {
      if (fault.kind != AttachmentFaultKind::kNoVertex &&
          fault.kind != AttachmentFaultKind::kOtherPiece) {
        continue;
      }
      fault.proof_below_m = leastOnTheWay(fault.robot) - kHalfDiagonal * raster_.resolution_m;
      of_ways.push_back(&fault);
      ways.emplace_back(robots_[fault.robot].start, robots_[fault.robot].goal);
    }
    if (ways.empty()) return;
    const auto found = findBottlenecks(raster_, ways, need, deadline_);
    deadline_.require();
    for (std::size_t i = 0; i < found.size(); ++i) of_ways[i]->bottleneck = found[i];
  }

  const ObstacleRaster& raster_;
  const Roadmap& roadmap_;
  const std::vector<RobotPoses>& robots_;
  const Deadline& deadline_;
  VertexFinder finder_;
  double snap_;  // [cells]
  Attachment result_;
};

}  // namespace

Attachment attachRobots(const ObstacleRaster& raster, const Roadmap& roadmap,
                        const std::vector<RobotPoses>& robots, double snap_distance_m,
                        const Deadline& deadline) {
  return Attacher(raster, roadmap, robots, snap_distance_m, deadline).run();
}

}  // namespace split_mapf
