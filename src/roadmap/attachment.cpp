#include "split_mapf/roadmap/attachment.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "roadmap/clear_space.h"
#include "roadmap/leg_matching.h"
#include "roadmap/leg_waves.h"
#include "split_mapf/core/graph.h"

namespace split_mapf {
namespace {

using roadmap::Leg;
using roadmap::LegOption;
using roadmap::LegWaves;
using roadmap::Place;

constexpr double kTouchM = 1e-6;

std::string metres(double length) {
  std::ostringstream text;
  text.precision(3);
  text << length << " m";
  return text.str();
}

std::string at(MapPoint p) {
  std::ostringstream text;
  text.precision(4);
  text << "(" << p.x << ", " << p.y << ")";
  return text.str();
}

/// The vertices of a planning graph by where they are, and the pieces that it falls into.
class VertexFinder {
 public:
  explicit VertexFinder(const Roadmap& roadmap) : roadmap_(roadmap) {
    const auto size = static_cast<std::uint32_t>(roadmap.cells.size());
    const Graph graph(size, roadmap.edges);
    pieces_.assign(size, kNoVertex);
    sizes_.assign(size, 0);
    std::vector<Vertex> queue;
    for (Vertex v = 0; v < size; ++v) {
      buckets_[bucketOf(placeOf(v))].push_back(v);
      if (pieces_[v] != kNoVertex) continue;
      queue.assign(1, v);
      pieces_[v] = v;
      for (std::size_t i = 0; i < queue.size(); ++i) {
        for (const Vertex u : graph.neighbours(queue[i])) {
          if (pieces_[u] != kNoVertex) continue;
          pieces_[u] = v;
          queue.push_back(u);
        }
      }
      sizes_[v] = static_cast<std::uint32_t>(queue.size());
    }
  }

  Place placeOf(Vertex v) const {
    const std::uint32_t row = roadmap_.cells[v] / roadmap_.width;
    return {static_cast<double>(roadmap_.cells[v] % roadmap_.width), static_cast<double>(row)};
  }
  /// A name of the piece that a vertex belongs to.
  Vertex pieceOf(Vertex v) const { return pieces_[v]; }
  std::uint32_t sizeOf(Vertex piece) const { return sizes_[piece]; }

  /// Vertices within `reach` cells of a place, in ascending order.
  std::vector<Vertex> near(Place p, double reach) const {
    std::vector<Vertex> found;
    const auto least = bucketOf({p.x - reach, p.y - reach});
    const auto most = bucketOf({p.x + reach, p.y + reach});
    for (std::int64_t row = least.first; row <= most.first; ++row) {
      for (std::int64_t column = least.second; column <= most.second; ++column) {
        const auto bucket = buckets_.find({row, column});
        if (bucket == buckets_.end()) continue;
        for (const Vertex v : bucket->second) {
          const Place to = placeOf(v);
          if (std::hypot(to.x - p.x, to.y - p.y) <= reach) found.push_back(v);
        }
      }
    }
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  std::pair<std::int64_t, std::int64_t> bucketOf(Place p) const {
    const double side = std::max(1U, roadmap_.spacing_cells);
    return {static_cast<std::int64_t>(std::floor(p.y / side)),
            static_cast<std::int64_t>(std::floor(p.x / side))};
  }

  const Roadmap& roadmap_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<Vertex>> buckets_;
  std::vector<Vertex> pieces_;
  std::vector<std::uint32_t> sizes_;
};

/// All starts, or all goals.
struct Side {
  const char* name;
  std::vector<MapPoint> poses;
  std::vector<std::vector<LegOption>> options;
};

class Attacher {
 public:
  Attacher(const ObstacleRaster& raster, const Roadmap& roadmap, double snap_distance_m)
      : raster_(raster),
        finder_(roadmap),
        need_((roadmap.robot_radius_m + roadmap.clearance_m) / raster.resolution_m),
        apart_m_(2 * roadmap.robot_radius_m + roadmap.clearance_m),
        snap_(snap_distance_m > 0 ? snap_distance_m / raster.resolution_m
                                  : static_cast<double>(roadmap.spacing_cells)) {}

  Attachment run(const std::vector<RobotPoses>& robots) {
    Side starts{"start", {}, {}};
    Side goals{"goal", {}, {}};
    for (const RobotPoses& robot : robots) {
      starts.poses.push_back(robot.start);
      goals.poses.push_back(robot.goal);
    }
    findOptions(starts, true);
    findOptions(goals, false);
    findOverlaps(starts);
    findOverlaps(goals);
    if (result_.faults.empty()) keepToOnePiece(starts, goals);
    if (result_.faults.empty()) result_.departure = matchAndOrder(starts);
    if (result_.faults.empty()) result_.arrival = matchAndOrder(goals);
    // Arriving is leaving the goals, played backwards.
    const std::uint32_t last = std::max(1U, result_.arrival.steps) - 1;
    for (std::uint32_t& wave : result_.arrival.waves) wave = last - wave;
    std::stable_sort(
        result_.faults.begin(), result_.faults.end(),
        [](const AttachmentFault& a, const AttachmentFault& b) { return a.robot < b.robot; });
    return std::move(result_);
  }

 private:
  void report(std::uint32_t robot, AttachmentFaultKind kind, const Side& side,
              const std::string& what) {
    result_.faults.push_back({robot, kind,
                              "robot " + std::to_string(robot) + ": its " + side.name + " " +
                                  at(side.poses[robot]) + " " + what});
  }

  Place toCells(MapPoint p) const {
    return {p.x / raster_.resolution_m - 0.5, p.y / raster_.resolution_m - 0.5};
  }

  /// @param forgiving  whether a pose may be too near to an obstacle, where a leg leads away from
  /// it
  void findOptions(Side& side, bool forgiving) {
    side.options.resize(side.poses.size());
    for (std::uint32_t robot = 0; robot < side.poses.size(); ++robot) {
      const Place pose = toCells(side.poses[robot]);
      if (!(pose.x >= -0.5 && pose.y >= -0.5 && pose.x <= raster_.width - 0.5 &&
            pose.y <= raster_.height - 0.5)) {
        report(robot, AttachmentFaultKind::kOutsideMap, side, "lies outside the map");
        continue;
      }
      const double touch = kTouchM / raster_.resolution_m;
      const double room = leastDistance(raster_, pose, pose, need_);
      const bool fits = room >= need_ - touch;
      if (fits || (forgiving && room > 0)) {
        for (const Vertex v : finder_.near(pose, snap_ + touch)) {
          const Place to = finder_.placeOf(v);
          if (leastDistance(raster_, pose, to, room) < room - touch) continue;
          const double dx = to.x - pose.x;
          const double dy = to.y - pose.y;
          side.options[robot].push_back({v, dx * dx + dy * dy, false});
        }
      }
      if (side.options[robot].empty()) reportNoOption(robot, side, room, fits);
    }
  }

  void reportNoOption(std::uint32_t robot, const Side& side, double room, bool fits) {
    if (fits) {
      report(robot, AttachmentFaultKind::kNoVertex, side,
             "has no clear straight way of at most " + metres(snap_ * raster_.resolution_m) +
                 " to a vertex of the planning graph");
    } else {
      report(robot, AttachmentFaultKind::kTooNearObstacle, side,
             "is " + metres(room * raster_.resolution_m) + " from an obstacle, " +
                 metres(need_ * raster_.resolution_m) + " are needed");
    }
  }

  void findOverlaps(const Side& side) {
    for (std::uint32_t i = 0; i < side.poses.size(); ++i) {
      for (std::uint32_t j = 0; j < i; ++j) {
        const double gap =
            std::hypot(side.poses[i].x - side.poses[j].x, side.poses[i].y - side.poses[j].y);
        if (!(gap < apart_m_ - kTouchM)) continue;  // or no number, which is reported already
        report(i, AttachmentFaultKind::kDiscsOverlap, side,
               "is " + metres(gap) + " from that of robot " + std::to_string(j) + ", " +
                   metres(apart_m_) + " are needed");
        break;
      }
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
        report(robot, AttachmentFaultKind::kOtherPiece, goals,
               "is near no vertex to which edges lead from those near its start");
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
      const auto lost = std::find(legs.vertices.begin(), legs.vertices.end(), kNoVertex);
      if (lost != legs.vertices.end()) {
        report(static_cast<std::uint32_t>(lost - legs.vertices.begin()),
               AttachmentFaultKind::kNoVertex, side,
               "has no vertex in reach that other robots leave to it");
        return legs;
      }
      std::vector<Leg> ways;
      bool any = false;
      for (std::uint32_t robot = 0; robot < side.poses.size(); ++robot) {
        ways.push_back({toCells(side.poses[robot]), finder_.placeOf(legs.vertices[robot])});
        any = any || std::hypot(ways.back().to.x - ways.back().from.x,
                                ways.back().to.y - ways.back().from.y) > kTouchM;
      }
      waves = roadmap::planWaves(ways, apart_m_ / raster_.resolution_m);
      if (waves.stuck.empty()) {
        legs.waves = waves.waves;
        legs.steps = any ? waves.count : 0;
        if (!any) legs.waves.assign(legs.waves.size(), 0);
        return legs;
      }
      if (!banLegOf(waves.stuck, legs.vertices, side)) break;
    }
    report(waves.stuck.front(), AttachmentFaultKind::kCrowd, side,
           "is hemmed in by other robots: no order of legs keeps them apart");
    return {};
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

  const ObstacleRaster& raster_;
  VertexFinder finder_;
  double need_;     // [cells] from an obstacle
  double apart_m_;  // between two robots
  double snap_;     // [cells]
  Attachment result_;
};

}  // namespace

Attachment attachRobots(const ObstacleRaster& raster, const Roadmap& roadmap,
                        const std::vector<RobotPoses>& robots, double snap_distance_m) {
  return Attacher(raster, roadmap, snap_distance_m).run(robots);
}

}  // namespace split_mapf
