#pragma once

#include <cstddef>

#include "split_mapf/io/picture.h"

namespace split_mapf {

/// What is free, and what is not.
constexpr Colour kFreeColour{251, 250, 247};
constexpr Colour kObstacleColour{58, 64, 79};

/// A colour by perceived lightness (0 .. 1), colourfulness (0 .. about 0.3) and hue (0 .. 1 round
/// the circle), so that equal steps look equal. Source: B. Ottosson, "A perceptual color space for
/// image processing" (Oklab), 2020; channels outside sRGB are clipped.
Colour perceptualColour(double lightness, double chroma, double hue);

/// The colour of a robot: neighbours in number are far apart in hue.
Colour robotColour(std::size_t robot);

/// How often a cell is used, 0 .. 1: from pale yellow to dark red.
Colour heatColour(double share);

/// A colour mixed with black; share 0 leaves it, 1 is black.
Colour darkened(Colour colour, double share);

}  // namespace split_mapf
