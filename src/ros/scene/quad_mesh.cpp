#include "ros/scene/quad_mesh.h"

#include <algorithm>
#include <cmath>

namespace split_mapf {
namespace {

constexpr float kMiddle = 0.5F;

/// What is not a number is nothing.
std::uint32_t toByte(float share) {
  return static_cast<std::uint32_t>(share > 0 ? 255 * std::min(share, 1.0F) + 0.5F : 0);
}

}  // namespace

PackedColour packed(float r, float g, float b, float a) {
  return toByte(r) | toByte(g) << 8U | toByte(b) << 16U | toByte(a) << 24U;
}

PackedColour withAlpha(PackedColour colour, float alpha) {
  return (colour & 0xFFFFFFU) | toByte(alpha) << 24U;
}

void QuadMesh::add(ScenePoint corner, float z, PackedColour colour, float u, float v) {
  corners_.push_back({corner.x, corner.y, z, colour, u, v});
}

void QuadMesh::addDisc(ScenePoint centre, float radius, float z, PackedColour colour) {
  if (kind_ == MeshKind::kDots) return add(centre, z, colour, kMiddle, kMiddle);
  add({centre.x - radius, centre.y - radius}, z, colour, 0, 0);
  add({centre.x + radius, centre.y - radius}, z, colour, 1, 0);
  add({centre.x + radius, centre.y + radius}, z, colour, 1, 1);
  add({centre.x - radius, centre.y + radius}, z, colour, 0, 1);
}

void QuadMesh::addSquare(ScenePoint centre, float half, float z, PackedColour colour) {
  if (kind_ == MeshKind::kDots) return add(centre, z, colour, kMiddle, kMiddle);
  addPiece({centre.x - half, centre.y - half}, {centre.x + half, centre.y - half},
           {centre.x + half, centre.y + half}, {centre.x - half, centre.y + half}, z, colour);
}

void QuadMesh::addBar(ScenePoint from, ScenePoint to, float width, float z,
                      PackedColour from_colour, PackedColour to_colour) {
  if (kind_ == MeshKind::kLines) {
    add(from, z, from_colour, kMiddle, kMiddle);
    return add(to, z, to_colour, kMiddle, kMiddle);
  }
  const float dx = to.x - from.x;
  const float dy = to.y - from.y;
  const float length = std::hypot(dx, dy);
  if (!(length > 0)) return;
  const float across_x = -dy / length * width / 2;
  const float across_y = dx / length * width / 2;
  add({from.x - across_x, from.y - across_y}, z, from_colour, kMiddle, kMiddle);
  add({to.x - across_x, to.y - across_y}, z, to_colour, kMiddle, kMiddle);
  add({to.x + across_x, to.y + across_y}, z, to_colour, kMiddle, kMiddle);
  add({from.x + across_x, from.y + across_y}, z, from_colour, kMiddle, kMiddle);
}

void QuadMesh::addPiece(ScenePoint a, ScenePoint b, ScenePoint c, ScenePoint d, float z,
                        PackedColour colour) {
  for (const ScenePoint corner : {a, b, c, d}) add(corner, z, colour, kMiddle, kMiddle);
}

}  // namespace split_mapf
