#include "split_mapf/io/disc_picture.h"

#include <algorithm>
#include <string>

#include "io/canvas.h"
#include "io/palette.h"
#include "io/raster_scale.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

constexpr Colour kObstacleColour{58, 64, 79};
constexpr Colour kFreeColour{251, 250, 247};

void requireDrawable(const ObstacleRaster& raster, const std::vector<Course>& courses,
                     const std::vector<double>& radius_m) {
  if (courses.size() != radius_m.size()) {
    throw InputError(counted(courses.size(), "way") + " of " + counted(radius_m.size(), "robot") +
                     ": one each is needed");
  }
  const double right = raster.width * raster.resolution_m;
  const double bottom = raster.height * raster.resolution_m;
  for (std::size_t i = 0; i < courses.size(); ++i) {
    if (courses[i].empty()) {
      throw InputError("robot " + std::to_string(i) + ": its way is empty, expected its start");
    }
    for (std::size_t step = 0; step < courses[i].size(); ++step) {
      const MapPoint p = courses[i][step];
      if (p.x >= 0 && p.y >= 0 && p.x <= right && p.y <= bottom) continue;
      throw InputError("robot " + std::to_string(i) + ": at step " + std::to_string(step) +
                       " it is outside the map that is to be drawn");
    }
  }
}

}  // namespace

Picture drawDiscs(const ObstacleRaster& raster, const std::vector<Course>& courses,
                  const std::vector<double>& radius_m, std::uint32_t cell_px) {
  requireDrawable(raster, courses, radius_m);
  const std::uint32_t px = rasterScaleFor(raster.width, raster.height, cell_px);
  const double scale = px / raster.resolution_m;
  Canvas canvas(raster.width * px, raster.height * px, kObstacleColour);
  for (std::size_t i = 0; i < raster.blocked.size(); ++i) {
    if (raster.blocked[i] != 0) continue;
    const Cell cell = raster.cellAt(i);
    canvas.fillRectangle(static_cast<std::uint32_t>(cell.x) * px,
                         static_cast<std::uint32_t>(cell.y) * px, px, px, kFreeColour);
  }
  const auto on_canvas = [scale](MapPoint p) { return Point{p.x * scale, p.y * scale}; };
  // A robot of no size is drawn as a dot; lines are thin enough to tell ways in one corridor apart.
  const auto radius_px = [&](std::size_t i) { return std::max(2.0, radius_m[i] * scale); };
  for (std::size_t i = 0; i < courses.size(); ++i) {
    std::vector<Point> line;
    for (const MapPoint p : courses[i]) line.push_back(on_canvas(p));
    canvas.strokeLine(line, std::clamp(radius_px(i) / 4, 1.2, 6.0), {robotColour(i), 0.8});
  }
  for (std::size_t i = 0; i < courses.size(); ++i) {
    const Point start = on_canvas(courses[i].front());
    canvas.fillDisc(start, radius_px(i), {robotColour(i), 1});
    canvas.fillDisc(start, radius_px(i) * 0.7, {kFreeColour, 1});
  }
  for (std::size_t i = 0; i < courses.size(); ++i) {
    const Point goal = on_canvas(courses[i].back());
    canvas.fillDisc(goal, radius_px(i), {darkened(robotColour(i), 0.35), 1});
    canvas.fillDisc(goal, radius_px(i) * 0.82, {robotColour(i), 1});
  }
  return canvas.take();
}

}  // namespace split_mapf
