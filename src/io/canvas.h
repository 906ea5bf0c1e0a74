#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/io/picture.h"

namespace split_mapf {

/// A point on a canvas [px]; pixel (0,0) covers 0 .. 1 on both axes.
struct Point {
  double x = 0;
  double y = 0;
};

/// How a shape is laid over what is there already.
struct Ink {
  Colour colour;
  double opacity = 1;  ///< 0 .. 1
};

/// A picture to draw on, with smooth edges. Shapes may reach over its border.
class Canvas {
 public:
  Canvas(std::uint32_t width_px, std::uint32_t height_px, Colour background);

  /// Draws on over a picture that is there.
  explicit Canvas(Picture picture);

  /// Fills whole pixels, from (x, y) on, opaquely. @pre they lie on the canvas.
  void fillRectangle(std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height,
                     Colour colour);
  /// A line of round ends and joints. It covers every pixel once, however often it crosses itself.
  void strokeLine(const std::vector<Point>& points, double width_px, Ink ink);
  /// A disc.
  void fillDisc(Point centre, double radius_px, Ink ink);

  /// Hands the picture over; the canvas is empty afterwards.
  Picture take();

 private:
  struct Box {
    std::int64_t left, top, right, bottom;  // right and bottom exclusive
    bool empty() const { return left >= right || top >= bottom; }
  };
  Box boxAround(Point a, Point b, double reach) const;
  void coverSegment(Point a, Point b, double radius);
  void blend(std::size_t pixel, Ink ink, double coverage);

  Picture picture_;
  // How much of each pixel the present line covers, and the pixels where it is not 0.
  std::vector<std::uint8_t> coverage_;
  std::vector<std::size_t> covered_;
};

}  // namespace split_mapf
