#include "split_mapf/io/picture.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "io/palette.h"
#include "io/plan_painter.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

void paintPlan(const CellPaths& paths, PlanPainter& painter) {
  for (std::size_t i = 0; i < paths.size(); ++i) painter.paintPath(i, paths[i]);
  for (std::size_t i = 0; i < paths.size(); ++i) painter.paintStart(i, paths[i].front());
  for (std::size_t i = 0; i < paths.size(); ++i) painter.paintGoal(i, paths[i].back());
}

// Pale tints that tell regions apart; cells that change owner are stronger.
std::vector<Colour> regionTints(const Layout& layout, const Ownership& ownership) {
  constexpr double kGoldenStep = 0.6180339887498949;
  std::vector<Colour> tints(ownership.size(), kFreeColour);
  const auto tint = [&](Vertex v, double lightness, double chroma) {
    if (ownership[v] == kNoRegion) return;
    const double hue = 0.08 + kGoldenStep * ownership[v];
    tints[v] = perceptualColour(lightness, chroma, hue - std::floor(hue));
  };
  for (Vertex v = 0; v < ownership.size(); ++v) tint(v, 0.95, 0.035);
  for (const Vertex v : bufferVertices(layout)) tint(v, 0.84, 0.085);
  return tints;
}

void requireLayout(const Grid& grid, const CellPaths& paths, const Layout& layout,
                   std::uint32_t phase) {
  if (phase >= layout.phases.size()) {
    throw InputError("the layout has no phase " + std::to_string(phase) + ", it has " +
                     std::to_string(layout.phases.size()));
  }
  for (const Ownership& ownership : layout.ownerships) {
    if (ownership.size() == grid.size()) continue;
    throw InputError("the layout is of " + counted(ownership.size(), "free cell") +
                     ", the map has " + std::to_string(grid.size()));
  }
  if (layout.phases[phase].ownership >= layout.ownerships.size() ||
      layout.phases[phase].states.size() != paths.size()) {
    throw InputError("phase " + std::to_string(phase) + " of the layout has " +
                     counted(layout.phases[phase].states.size(), "state") +
                     ", expected one for each of " + counted(paths.size(), "robot") +
                     " and an ownership that is there");
  }
}

}  // namespace

Picture drawPlan(const Grid& grid, const CellPaths& paths, const Layout& layout,
                 std::uint32_t phase, const PictureOptions& options) {
  requireDrawable(grid, paths);
  requireLayout(grid, paths, layout, phase);
  const Layout::Phase& shown = layout.phases[phase];
  PlanPainter painter(grid, paths.size(), options);
  painter.paintGrid(regionTints(layout, layout.ownerships[shown.ownership]));
  paintPlan(paths, painter);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    painter.paintState(i, grid.cellOf(shown.states[i]));
  }
  return painter.take();
}

Picture drawPlan(const Grid& grid, const CellPaths& paths, const PictureOptions& options) {
  requireDrawable(grid, paths);
  PlanPainter painter(grid, paths.size(), options);
  painter.paintGrid();
  paintPlan(paths, painter);
  return painter.take();
}

Picture drawInstance(const Grid& grid, const std::vector<Cell>& starts,
                     const std::vector<Cell>& goals, const PictureOptions& options) {
  if (starts.size() != goals.size()) {
    throw InputError(counted(starts.size(), "start") + " and " + counted(goals.size(), "goal") +
                     ", expected as many");
  }
  for (std::size_t i = 0; i < starts.size(); ++i) {
    requireInside(grid, i, "the start", starts[i]);
    requireInside(grid, i, "the goal", goals[i]);
  }
  PlanPainter painter(grid, starts.size(), options);
  painter.paintGrid();
  for (std::size_t i = 0; i < starts.size(); ++i) painter.paintStraightLine(i, starts[i], goals[i]);
  for (std::size_t i = 0; i < starts.size(); ++i) painter.paintStart(i, starts[i]);
  for (std::size_t i = 0; i < starts.size(); ++i) painter.paintGoal(i, goals[i]);
  return painter.take();
}

}  // namespace split_mapf
