#include "split_mapf/generate/pose_generator.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "roadmap/clear_space.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/random.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/roadmap/map_frame.h"

namespace split_mapf {
namespace {

constexpr double kPi = 3.14159265358979323846;
// As many fine places in a cell, a side.
constexpr std::uint64_t kPlaces = 1U << 20U;
// Draws of one pose before the map counts as full, and rounds of drawing robots anew.
constexpr int kMostDraws = 2000;
constexpr int kMostRounds = 50;

class PoseDrawer {
 public:
  PoseDrawer(const PoseDraw& draw, const Deadline& deadline)
      : draw_(draw),
        deadline_(deadline),
        engine_(draw.seed),
        need_cells_((draw.roadmap.robot_radius_m + draw.roadmap.clearance_m) /
                    draw.raster->resolution_m) {}

  DrawnPoses run() {
    const std::optional<Roadmap> roadmap = buildRoadmap(*draw_.raster, draw_.roadmap, deadline_);
    if (!roadmap) throw Interrupted();
    for (std::size_t i = 0; i < roadmap->ground.size(); ++i) {
      if (roadmap->ground[i] != 0) ground_.push_back(static_cast<std::uint32_t>(i));
    }
    result_.robots.assign(draw_.robots, RobotPoses{kNowhere, kNowhere});
    std::vector<std::uint32_t> missing(draw_.robots);
    for (std::uint32_t i = 0; i < draw_.robots; ++i) missing[i] = i;
    for (int round = 0; round < kMostRounds; ++round) {
      for (const std::uint32_t robot : missing) drawRobot(robot);
      missing = faultyBy(
          attachRobots(*draw_.raster, *roadmap, result_.robots, draw_.snap_distance_m, deadline_));
      if (missing.empty()) return withYaws();
      result_.left_out += static_cast<std::uint32_t>(missing.size());
      for (const std::uint32_t robot : missing)
        result_.robots[robot] = RobotPoses{kNowhere, kNowhere};
    }
    refuse("can be brought onto the planning graph at once");
  }

 private:
  static constexpr MapPoint kNowhere{-1e9, -1e9};

  [[noreturn]] void refuse(const std::string& what) const {
    throw OptionError("the map has no room for " + counted(draw_.robots, "robot") +
                      " of this size: not so many " + what);
  }

  void drawRobot(std::uint32_t robot) {
    result_.robots[robot].start = drawPose(&RobotPoses::start);
    result_.robots[robot].goal = drawPose(&RobotPoses::goal);
  }

  MapPoint drawPose(MapPoint RobotPoses::*end) {
    const double apart = 2 * draw_.roadmap.robot_radius_m + draw_.roadmap.clearance_m + kSparePoseM;
    const double side = draw_.raster->resolution_m;
    for (int tries = 0; tries < kMostDraws; ++tries) {
      const Cell cell = draw_.raster->cellAt(ground_[drawBelow(engine_, ground_.size())]);
      const double dx = static_cast<double>(drawBelow(engine_, kPlaces)) / kPlaces - 0.5;
      const double dy = static_cast<double>(drawBelow(engine_, kPlaces)) / kPlaces - 0.5;
      const roadmap::Place place{cell.x + dx, cell.y + dy};
      if (roadmap::leastDistance(*draw_.raster, place, place, need_cells_) < need_cells_) continue;
      const MapPoint p{(place.x + 0.5) * side, (place.y + 0.5) * side};
      const bool free =
          std::all_of(result_.robots.begin(), result_.robots.end(), [&](const RobotPoses& other) {
            return std::hypot(p.x - (other.*end).x, p.y - (other.*end).y) >= apart;
          });
      if (free) return p;
    }
    refuse("can stand " + inMetres(apart) + " apart");
  }

  static std::vector<std::uint32_t> faultyBy(const Attachment& attachment) {
    std::set<std::uint32_t> robots;
    for (const AttachmentFault& fault : attachment.faults) robots.insert(fault.robot);
    return {robots.begin(), robots.end()};
  }

  DrawnPoses withYaws() {
    const auto draw_yaw = [this] {
      return kPi * (2 * static_cast<double>(drawBelow(engine_, kPlaces)) / kPlaces - 1);
    };
    for (std::uint32_t i = 0; i < draw_.robots; ++i) {
      result_.start_yaws_rad.push_back(draw_yaw());
      result_.goal_yaws_rad.push_back(draw_yaw());
    }
    return std::move(result_);
  }

  const PoseDraw& draw_;
  const Deadline& deadline_;
  RandomEngine engine_;
  double need_cells_;
  std::vector<std::uint32_t> ground_;
  DrawnPoses result_;
};

}  // namespace

DrawnPoses drawPoses(const PoseDraw& draw, const Deadline& deadline) {
  return PoseDrawer(draw, deadline).run();
}

}  // namespace split_mapf
