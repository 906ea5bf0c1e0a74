#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "split_mapf/core/grid.h"
#include "split_mapf/core/layout.h"
#include "split_mapf/io/cell_paths.h"

namespace split_mapf {

/// A colour of a picture, 0 .. 255 a channel.
struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  friend bool operator==(Colour a, Colour b) {
    return a.red == b.red && a.green == b.green && a.blue == b.blue;
  }
};

/// A picture in memory. `pixels` is row-major from the top, width_px * height_px entries.
struct Picture {
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  std::vector<Colour> pixels;
  Colour at(std::uint32_t x, std::uint32_t y) const {
    return pixels[std::size_t{y} * width_px + x];
  }
};

/// How a picture is drawn. The defaults suit every size of map.
struct PictureOptions {
  /// Pixels a cell, 1 .. 256. 0: so that the picture is about as large as 1000x1000 pixels, with 4
  /// to 64 a cell; above 1024 cells a side 2, or 1 where even that gets too large.
  std::uint32_t cell_px = 0;
  /// Whether thin lines part the free cells, where a cell has at least 12 pixels.
  bool grid_lines = true;
  /// Width of a path [cells], at most 1. 0: thinner the more robots there are.
  double line_width_cells = 0;
  /// Opacity of a path, at most 1. 0: fainter the more robots there are.
  double opacity = 0;
};

/// Draws a plan: every robot's path as a line in its own hue, its start as a hollow circle, its
/// goal as a disc. Robots are told apart by their index, so that one robot keeps its colour in all
/// pictures of the same number of robots.
/// @throws InputError naming robot and step when a path is empty or leaves the grid (a blocked
/// cell or a jump is drawn as it is), or when the picture would exceed 2^27 pixels; OptionError for
/// an option out of range. Cost: O(pixels + moves * cell_px^2). Thread-safe.
Picture drawPlan(const Grid& grid, const CellPaths& paths, const PictureOptions& options = {});

/// Draws a plan over one phase of its space split: every region in a tint of its own, stronger in
/// the buffer zones (the cells that change owner), and where the phase ends for each robot as a
/// ringed dot in the robot's colour.
/// @throws as drawPlan; InputError when the layout has no such phase, is not of this grid, or has
/// not one state a robot.
Picture drawPlan(const Grid& grid, const CellPaths& paths, const Layout& layout,
                 std::uint32_t phase, const PictureOptions& options = {});

/// Draws starts and goals alone, each pair joined by a faint straight line. @throws as drawPlan;
/// InputError when the two lists differ in length.
Picture drawInstance(const Grid& grid, const std::vector<Cell>& starts,
                     const std::vector<Cell>& goals, const PictureOptions& options = {});

/// Writes a picture as a PNG file. @throws InputError when the file cannot be written.
void writePng(const std::string& path, const Picture& picture);

}  // namespace split_mapf
