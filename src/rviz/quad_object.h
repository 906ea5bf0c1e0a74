#pragma once

#include <cstddef>

#include <OgreMaterial.h>
#include <OgreSimpleRenderable.h>

#include "ros/scene/quad_mesh.h"

namespace split_mapf {

/// A mesh in the scene: one object, one draw call, however many robots. Of the GUI thread.
class QuadObject : public Ogre::SimpleRenderable {
 public:
  /// @param discs  false: the mesh has none, and is drawn without their picture, which is cheaper.
  explicit QuadObject(bool discs);
  ~QuadObject() override;

  /// Shows the mesh in place of the last one. Cost: a copy of it to the graphics card.
  void show(const QuadMesh& mesh);

  /// Leaves itself out where it has nothing to draw, whoever made it visible.
  void _updateRenderQueue(Ogre::RenderQueue* queue) override;
  Ogre::Real getBoundingRadius() const override;
  Ogre::Real getSquaredViewDepth(const Ogre::Camera* camera) const override;

 private:
  void reserve(std::size_t corners);
  void choose(const QuadMesh& mesh);
  void use(const Ogre::MaterialPtr& material);

  Ogre::MaterialPtr plain_;
  Ogre::MaterialPtr pictured_;  // with the disc; null: the mesh has none

  std::size_t capacity_ = 0;  // [corners]
};

}  // namespace split_mapf
