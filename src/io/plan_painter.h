#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/canvas.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/io/cell_paths.h"
#include "split_mapf/io/picture.h"

namespace split_mapf {

/// @throws InputError naming robot and what of it lies outside the map.
void requireInside(const Grid& grid, std::size_t robot, const std::string& what, Cell cell);
/// The same for whole paths, and when one is empty.
void requireDrawable(const Grid& grid, const CellPaths& paths);

/// Draws one plan or instance on a grid, layer by layer. @pre grid and options outlive it.
class PlanPainter {
 public:
  /// @throws OptionError, InputError as drawPlan().
  PlanPainter(const Grid& grid, std::size_t robots, const PictureOptions& options);

  /// @param tints  a colour a free cell; empty: all the same.
  void paintGrid(const std::vector<Colour>& tints = {});
  void paintPath(std::size_t robot, const std::vector<Cell>& path);
  void paintStraightLine(std::size_t robot, Cell start, Cell goal);
  /// A hollow circle, wide enough to stay visible round another robot's goal.
  void paintStart(std::size_t robot, Cell cell);
  void paintGoal(std::size_t robot, Cell cell);
  /// A ringed dot, smaller than a goal.
  void paintState(std::size_t robot, Cell cell);

  Point centreOf(Cell cell) const { return onCanvas({cell.x + 0.5, cell.y + 0.5}); }
  std::uint32_t cellSize() const { return cell_px_; }
  Picture take() { return canvas_.take(); }

 private:
  Point onCanvas(Point in_cells) const {
    return {margin_px_ + in_cells.x * cell_px_, margin_px_ + in_cells.y * cell_px_};
  }
  static Point laneOf(std::size_t robot);

  const Grid& grid_;
  const PictureOptions& options_;
  const std::uint32_t cell_px_;
  const std::uint32_t margin_px_;
  Canvas canvas_;
  double line_px_ = 1;
  double opacity_ = 1;
};

}  // namespace split_mapf
