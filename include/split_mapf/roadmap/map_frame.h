#pragma once

#include <string>

namespace split_mapf {

/// A place in metres. On a raster: from the corner of its first cell, x along rows, y along
/// columns.
struct MapPoint {
  double x = 0;
  double y = 0;
};

/// Where a raster lies in the frame that its user knows: in the frame, y goes up and (x_m, y_m) is
/// the corner where the raster's last row begins. A plain value.
struct MapFrame {
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;   ///< by which the raster is turned, counterclockwise
  double height_m = 0;  ///< of the raster
};

/// From the frame to the raster, and back.
MapPoint toRaster(const MapFrame& frame, MapPoint point);
MapPoint toFrame(const MapFrame& frame, MapPoint point);

/// "(12.3, 4.5)": a place of the raster as the frame's users know it, to the millimetre.
std::string describe(const MapFrame& frame, MapPoint point);
/// "0.35 m": a length to the millimetre, or, below, to three digits.
std::string inMetres(double length);

}  // namespace split_mapf
