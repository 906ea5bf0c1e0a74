#include "split_mapf/io/plan_film.h"

#include <algorithm>
#include <cmath>

#include "io/canvas.h"
#include "io/disc_painter.h"
#include "io/palette.h"
#include "io/plan_painter.h"
#include "io/raster_scale.h"

namespace split_mapf {

PlanFilm::PlanFilm(const Grid& grid, const CellPaths& paths, const PictureOptions& options) {
  requireDrawable(grid, paths);
  PlanPainter painter(grid, paths.size(), options);
  painter.paintGrid();
  for (std::size_t robot = 0; robot < paths.size(); ++robot) {
    painter.paintStart(robot, paths[robot].back());
    std::vector<Place>& track = tracks_.emplace_back();
    for (const Cell cell : paths[robot]) {
      const Point centre = painter.centreOf(cell);
      track.push_back({centre.x, centre.y});
    }
  }
  radius_px_.assign(paths.size(), std::max(0.4 * painter.cellSize(), 1.5));
  background_ = painter.take();
}

PlanFilm::PlanFilm(const ObstacleRaster& raster, const std::vector<Course>& courses,
                   const std::vector<double>& radius_m, std::uint32_t cell_px) {
  requireDrawable(raster, courses, radius_m);
  const std::uint32_t px = rasterScaleFor(raster.width, raster.height, cell_px);
  const double scale = px / raster.resolution_m;
  Canvas canvas = canvasOf(raster, px);
  for (std::size_t robot = 0; robot < courses.size(); ++robot) {
    radius_px_.push_back(std::max(2.0, radius_m[robot] * scale));
    std::vector<Place>& track = tracks_.emplace_back();
    for (const MapPoint point : courses[robot]) track.push_back({point.x * scale, point.y * scale});
    const Point goal{track.back().x, track.back().y};
    canvas.fillDisc(goal, radius_px_[robot], {robotColour(robot), 1});
    canvas.fillDisc(goal, radius_px_[robot] * 0.7, {kFreeColour, 1});
  }
  background_ = canvas.take();
}

double PlanFilm::lastStep() const {
  std::size_t last = 0;
  for (const std::vector<Place>& track : tracks_) last = std::max(last, track.size() - 1);
  return static_cast<double>(last);
}

PlanFilm::Place PlanFilm::placeAt(std::size_t robot, double step) const {
  const std::vector<Place>& track = tracks_[robot];
  const double within = std::clamp(step, 0.0, static_cast<double>(track.size() - 1));
  const auto begin = static_cast<std::size_t>(within);
  const Place from = track[begin];
  const Place to = track[std::min(begin + 1, track.size() - 1)];
  const double part = within - static_cast<double>(begin);
  return {from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)};
}

Picture PlanFilm::at(double step) const {
  Canvas canvas(background_);
  for (std::size_t robot = 0; robot < tracks_.size(); ++robot) {
    const Place place = placeAt(robot, step);
    const Colour colour = robotColour(robot);
    canvas.fillDisc({place.x, place.y}, radius_px_[robot], {darkened(colour, 0.35), 1});
    canvas.fillDisc({place.x, place.y}, radius_px_[robot] * 0.8, {colour, 1});
  }
  return canvas.take();
}

Picture drawHeat(const Grid& grid, const CellPaths& paths, const PictureOptions& options) {
  requireDrawable(grid, paths);
  std::vector<std::uint32_t> uses(grid.size(), 0);
  for (const std::vector<Cell>& path : paths) {
    for (const Cell cell : path) {
      if (grid.isFree(cell)) ++uses[grid.vertexAt(cell)];
    }
  }
  const std::uint32_t most = uses.empty() ? 0 : *std::max_element(uses.begin(), uses.end());
  std::vector<Colour> tints(grid.size(), kFreeColour);
  for (Vertex v = 0; v < grid.size(); ++v) {
    if (uses[v] > 0) tints[v] = heatColour(std::log(uses[v]) / std::max(1.0, std::log(most)));
  }
  PlanPainter painter(grid, paths.size(), options);
  painter.paintGrid(tints);
  return painter.take();
}

}  // namespace split_mapf
