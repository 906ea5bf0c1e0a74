#include "split_mapf/io/disc_picture.h"

#include <algorithm>

#include "io/disc_painter.h"
#include "io/palette.h"
#include "io/raster_scale.h"

namespace split_mapf {

Picture drawDiscs(const ObstacleRaster& raster, const std::vector<Course>& courses,
                  const std::vector<double>& radius_m, std::uint32_t cell_px) {
  requireDrawable(raster, courses, radius_m);
  const std::uint32_t px = rasterScaleFor(raster.width, raster.height, cell_px);
  const double scale = px / raster.resolution_m;
  Canvas canvas = canvasOf(raster, px);
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
