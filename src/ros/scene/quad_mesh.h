#pragma once

#include <cstdint>
#include <vector>

#include "ros/scene/plan_scene.h"

namespace split_mapf {

/// Red, green, blue, alpha of one byte each; red lowest.
using PackedColour = std::uint32_t;

/// @param r,g,b,a  0 to 1.
PackedColour packed(float r, float g, float b, float a = 1);
/// The colour with another alpha, 0 to 1.
PackedColour withAlpha(PackedColour colour, float alpha);

/// A corner as the graphics card takes it.
struct QuadVertex {
  float x, y, z;
  PackedColour colour;
  float u, v;  ///< in a picture of a disc whose edge touches the picture's
};

/// What the corners of a mesh are: pieces of four, ends of thin lines, or middles of dots. Dots and
/// thin lines have a size in pixels, and cost a fraction where GL is software.
enum class MeshKind { kPieces, kLines, kDots };

/// Four-cornered pieces that are drawn as one object with one picture, that of a disc: discs show
/// all of it, all else its middle only. Corners of a piece go around it. Not thread-safe.
class QuadMesh {
 public:
  void clear(MeshKind kind = MeshKind::kPieces) {
    corners_.clear();
    kind_ = kind;
  }
  MeshKind kind() const { return kind_; }
  /// [pixels] of all dots.
  float dotSize() const { return dot_size_; }
  void setDotSize(float pixels) { dot_size_ = pixels; }
  /// Four a piece, two a line, one a dot.
  const std::vector<QuadVertex>& corners() const { return corners_; }

  /// A dot where the mesh is one of dots.
  void addDisc(ScenePoint centre, float radius, float z, PackedColour colour);
  /// A square with its sides along the axes; a dot where the mesh is one of dots. @param half  [m]
  /// of a side.
  void addSquare(ScenePoint centre, float half, float z, PackedColour colour);
  /// A straight bar between two points, coloured from one end to the other; nothing where they are
  /// one.
  void addBar(ScenePoint from, ScenePoint to, float width, float z, PackedColour from_colour,
              PackedColour to_colour);
  /// Any piece.
  void addPiece(ScenePoint a, ScenePoint b, ScenePoint c, ScenePoint d, float z,
                PackedColour colour);

 private:
  void add(ScenePoint corner, float z, PackedColour colour, float u, float v);

  std::vector<QuadVertex> corners_;
  MeshKind kind_ = MeshKind::kPieces;
  float dot_size_ = 1;
};

}  // namespace split_mapf
