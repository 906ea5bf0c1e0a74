#include "tool/roll_ground.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/pipeline/disc_problem.h"
#include "split_mapf/roadmap/courses.h"
#include "tool/disc_task.h"

namespace split_mapf::tool {

RollGround::RollGround(const CommandLine& line, const Deadline& deadline)
    : options_(readRobotOptions(line)) {
  const std::string file = line.text("map");
  if (!asksForRoadmap(options_.roadmap)) {
    requireNoGraphOptions(line);
    map_ = readMapOfPoints(file, options_);
    return;
  }
  metres_ = readMapInMetres(file, options_);
  auto raster = std::make_shared<const ObstacleRaster>(obstaclesOf(*metres_, options_));
  map_ = std::make_shared<const Grid>(raster->width, raster->height, freeCells(*raster));
  discs_ = std::make_unique<const DiscGround>(std::move(raster), options_.roadmap,
                                              options_.snap_distance_m, deadline);
}

std::vector<Vertex> RollGround::verticesOf(const std::vector<Cell>& cells,
                                           const std::string& who) const {
  std::vector<Vertex> vertices;
  vertices.reserve(cells.size());
  for (const Cell cell : cells) {
    if (!discs_) {
      vertices.push_back(map_->vertexAt(cell));
      continue;
    }
    const double side_m = metres_->resolution_m;
    const MapPoint centre{(cell.x + 0.5) * side_m, (cell.y + 0.5) * side_m};
    const std::optional<Vertex> vertex = discs_->nearest(centre, discs_->snapDistance());
    if (!vertex) {
      throw InputError(who + ": no vertex of the planning graph is within " +
                       inMetres(discs_->snapDistance()) + " of cell " + toString(cell) +
                       " by a straight way on which a robot fits (--snap-distance)");
    }
    vertices.push_back(*vertex);
  }
  return vertices;
}

void RollGround::requireApart(const RollReport& report) const {
  if (!discs_) return;
  std::vector<Course> courses;
  std::vector<std::string> names;
  for (const Path& path : report.paths) {
    names.push_back("robot " + std::to_string(courses.size()));
    Course& course = courses.emplace_back();
    for (const Vertex v : path) course.push_back(placeOf(discs_->roadmap(), v));
  }
  const Roadmap& roadmap = discs_->roadmap();
  const Discs discs{std::vector<double>(courses.size(), roadmap.robot_radius_m),
                    roadmap.clearance_m};
  const DiscCheck check = checkDiscs(discs_->raster(), discs, courses, 1);
  if (check.violations.empty()) return;
  throw std::logic_error("the run is not safe: " +
                         explain(check.violations.front(), names, frameOf(*metres_)));
}

std::optional<double> RollGround::stepDuration() const {
  if (!discs_ || options_.robot_speed_mps <= 0) return std::nullopt;
  return discs_->roadmap().longest_edge_m / options_.robot_speed_mps;
}

}  // namespace split_mapf::tool
