#include "split_mapf/roadmap/map_frame.h"

#include <cmath>

#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

/// No more than millimetres, and no negative zero.
std::string rounded(double length) { return numeral(std::round(length * 1000) / 1000 + 0.0); }

}  // namespace

MapPoint toRaster(const MapFrame& frame, MapPoint point) {
  const double dx = point.x - frame.x_m;
  const double dy = point.y - frame.y_m;
  const double cosine = std::cos(frame.yaw_rad);
  const double sine = std::sin(frame.yaw_rad);
  return {cosine * dx + sine * dy, frame.height_m - (cosine * dy - sine * dx)};
}

MapPoint toFrame(const MapFrame& frame, MapPoint point) {
  const double up = frame.height_m - point.y;
  const double cosine = std::cos(frame.yaw_rad);
  const double sine = std::sin(frame.yaw_rad);
  return {frame.x_m + cosine * point.x - sine * up, frame.y_m + sine * point.x + cosine * up};
}

std::string describe(const MapFrame& frame, MapPoint point) {
  const MapPoint known = toFrame(frame, point);
  return "(" + rounded(known.x) + ", " + rounded(known.y) + ")";
}

std::string inMetres(double length) {
  return (std::abs(length) < 0.01 ? numeral(length) : rounded(length)) + " m";
}

}  // namespace split_mapf
