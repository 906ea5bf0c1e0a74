#include "io/plan_painter.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "io/palette.h"
#include "io/path_line.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

constexpr Colour kGridLineColour{236, 233, 226};
constexpr Colour kPaper{255, 255, 255};
constexpr std::uint64_t kMaxPixels = std::uint64_t{1} << 27U;
constexpr std::uint32_t kGridLinesFromPx = 12;

std::uint32_t marginFor(std::uint32_t cell_px) { return std::max(4U, cell_px / 3); }

std::uint64_t pixelsAt(const Grid& grid, std::uint32_t cell_px) {
  const std::uint64_t margin = 2ULL * marginFor(cell_px);
  return (std::uint64_t{grid.width()} * cell_px + margin) *
         (std::uint64_t{grid.height()} * cell_px + margin);
}

// A picture as large as 1000x1000, but not longer than 2000, unless cells would get too small.
std::uint32_t automaticCellSize(const Grid& grid) {
  const double longer = std::max(grid.width(), grid.height());
  const double mean = std::sqrt(static_cast<double>(grid.width()) * grid.height());
  const auto cell_px =
      static_cast<std::uint32_t>(std::lround(std::min(1000 / mean, 2000 / longer)));
  if (longer <= 1024) return std::clamp(cell_px, 4U, 64U);
  return pixelsAt(grid, 2) <= kMaxPixels ? 2 : 1;
}

std::uint32_t cellSizeFor(const Grid& grid, const PictureOptions& options) {
  std::uint32_t cell_px = options.cell_px;
  if (cell_px > 256) {
    throw OptionError("a cell of " + std::to_string(cell_px) + " pixels, expected 1 to 256");
  }
  if (cell_px == 0) cell_px = automaticCellSize(grid);
  if (pixelsAt(grid, cell_px) > kMaxPixels) {
    throw InputError("a picture of a " + std::to_string(grid.width()) + "x" +
                     std::to_string(grid.height()) + " grid with " + std::to_string(cell_px) +
                     " pixels a cell is too large, expected at most " + std::to_string(kMaxPixels) +
                     " pixels");
  }
  return cell_px;
}

// Takes `value` where it is given, else `automatic`.
double choose(const std::string& name, double value, double automatic, double most) {
  if (!(value >= 0 && value <= most)) {
    throw OptionError(name + " is " + std::to_string(value) + ", expected above 0 and at most " +
                      std::to_string(most) + ", or 0 for automatic");
  }
  return value > 0 ? value : automatic;
}

}  // namespace

void requireInside(const Grid& grid, std::size_t robot, const std::string& what, Cell cell) {
  if (grid.contains(cell)) return;
  throw InputError("robot " + std::to_string(robot) + ": " + what + " " + toString(cell) +
                   " is outside the " + std::to_string(grid.width()) + "x" +
                   std::to_string(grid.height()) + " map that is to be drawn");
}

void requireDrawable(const Grid& grid, const CellPaths& paths) {
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (paths[i].empty()) {
      throw InputError("robot " + std::to_string(i) + ": its path is empty, expected its start");
    }
    for (std::size_t t = 0; t < paths[i].size(); ++t) {
      if (grid.contains(paths[i][t])) continue;
      requireInside(grid, i, "at step " + std::to_string(t) + " the cell", paths[i][t]);
    }
  }
}

PlanPainter::PlanPainter(const Grid& grid, std::size_t robots, const PictureOptions& options)
    : grid_(grid),
      options_(options),
      cell_px_(cellSizeFor(grid, options)),
      margin_px_(marginFor(cell_px_)),
      canvas_(grid.width() * cell_px_ + 2 * margin_px_, grid.height() * cell_px_ + 2 * margin_px_,
              kObstacleColour) {
  // The share of free cells that lie on some path decides how crowded the picture is.
  const double crowd =
      std::sqrt(static_cast<double>(robots) / std::max(1.0, std::sqrt(double(grid.size()))));
  const double automatic_cells = std::clamp(0.20 / std::max(1.0, crowd), 0.07, 0.20);
  const double line_cells =
      choose("line_width_cells", options.line_width_cells, automatic_cells, 1);
  line_px_ = line_cells * cell_px_;
  if (options.line_width_cells == 0) line_px_ = std::max(line_px_, 1.1);
  opacity_ =
      choose("opacity", options.opacity, std::clamp(0.9 / std::max(1.0, crowd), 0.6, 0.9), 1);
}

void PlanPainter::paintGrid(const std::vector<Colour>& tints) {
  const bool lines = options_.grid_lines && cell_px_ >= kGridLinesFromPx;
  for (Vertex v = 0; v < grid_.size(); ++v) {
    const Cell cell = grid_.cellOf(v);
    const std::uint32_t x = margin_px_ + static_cast<std::uint32_t>(cell.x) * cell_px_;
    const std::uint32_t y = margin_px_ + static_cast<std::uint32_t>(cell.y) * cell_px_;
    canvas_.fillRectangle(x, y, cell_px_, cell_px_, tints.empty() ? kFreeColour : tints[v]);
    if (!lines) continue;
    if (grid_.isFree({cell.x + 1, cell.y})) {
      canvas_.fillRectangle(x + cell_px_ - 1, y, 1, cell_px_, kGridLineColour);
    }
    if (grid_.isFree({cell.x, cell.y + 1})) {
      canvas_.fillRectangle(x, y + cell_px_ - 1, cell_px_, 1, kGridLineColour);
    }
  }
}

void PlanPainter::paintPath(std::size_t robot, const std::vector<Cell>& path) {
  std::vector<Point> course = courseOf(path, laneOf(robot));
  for (Point& point : course) point = onCanvas(point);
  canvas_.strokeLine(course, line_px_, {robotColour(robot), opacity_});
}

void PlanPainter::paintStraightLine(std::size_t robot, Cell start, Cell goal) {
  canvas_.strokeLine({centreOf(start), centreOf(goal)}, line_px_,
                     {robotColour(robot), 0.5 * opacity_});
}

void PlanPainter::paintStart(std::size_t robot, Cell cell) {
  const double radius = std::max(0.32 * cell_px_, 1.5);
  canvas_.fillDisc(centreOf(cell), radius, {robotColour(robot), 1});
  canvas_.fillDisc(centreOf(cell), radius * 0.68, {kPaper, 1});
}

void PlanPainter::paintGoal(std::size_t robot, Cell cell) {
  const Colour colour = robotColour(robot);
  const double radius = std::max(0.28 * cell_px_, 1.4);
  canvas_.fillDisc(centreOf(cell), radius, {darkened(colour, 0.35), 1});
  canvas_.fillDisc(centreOf(cell), radius * 0.78, {colour, 1});
}

void PlanPainter::paintState(std::size_t robot, Cell cell) {
  const double radius = std::max(0.24 * cell_px_, 1.3);
  canvas_.fillDisc(centreOf(cell), radius, {kObstacleColour, 1});
  canvas_.fillDisc(centreOf(cell), radius * 0.7, {robotColour(robot), 1});
}

// Two sequences that fill the square evenly (R2, from the plastic number), within a cell's
// middle.
Point PlanPainter::laneOf(std::size_t robot) {
  constexpr double kSpread = 0.5;
  const auto part = [robot](double step) {
    const double value = 0.5 + step * static_cast<double>(robot);
    return kSpread * (value - std::floor(value) - 0.5);
  };
  return {part(0.7548776662466927), part(0.5698402909980532)};
}

}  // namespace split_mapf
