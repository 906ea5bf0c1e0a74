#include "io/disc_painter.h"

#include <string>

#include "io/palette.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {

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

Canvas canvasOf(const ObstacleRaster& raster, std::uint32_t cell_px) {
  Canvas canvas(raster.width * cell_px, raster.height * cell_px, kObstacleColour);
  for (std::size_t i = 0; i < raster.blocked.size(); ++i) {
    if (raster.blocked[i] != 0) continue;
    const Cell cell = raster.cellAt(i);
    canvas.fillRectangle(static_cast<std::uint32_t>(cell.x) * cell_px,
                         static_cast<std::uint32_t>(cell.y) * cell_px, cell_px, cell_px,
                         kFreeColour);
  }
  return canvas;
}

}  // namespace split_mapf
