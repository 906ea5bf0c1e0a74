#pragma once

#include <array>
#include <memory>
#include <string>

#include <OgreSceneNode.h>
#include <geometry_msgs/Point.h>

#include "ros/scene/quad_mesh.h"
#include "rviz/quad_object.h"

namespace rviz {
class DisplayContext;
}

namespace split_mapf {

/// What a display draws, from below to above.
enum class SceneLayer {
  kLayout,
  kRoadmap,
  kTrails,
  kGoals,
  kRobots,
  kWaits,
  kMarks,
  kDraft,
  kCount
};

/// The display's objects in the scene: one a layer, each where its message's frame has it. Of the
/// GUI thread.
class SceneLayers {
 public:
  /// @param parent  owned by the display; outlives this object.
  SceneLayers(rviz::DisplayContext& context, Ogre::SceneNode* parent);
  SceneLayers(const SceneLayers&) = delete;
  SceneLayers& operator=(const SceneLayers&) = delete;
  ~SceneLayers();

  /// The mesh that the layer shows after present(); cleared by this call.
  QuadMesh& begin(SceneLayer layer);
  void present(SceneLayer layer) { at(layer).object->show(at(layer).mesh); }
  void hide(SceneLayer layer);
  /// Puts the layer's points into a frame, counted from `origin` there.
  void attach(SceneLayer layer, const std::string& frame, const geometry_msgs::Point& origin);
  /// Follows the frames. Returns the first one that cannot be transformed, whose layers are hidden;
  /// empty: all can.
  std::string follow();
  /// The node of a layer, in whose coordinates its points are.
  Ogre::SceneNode* node(SceneLayer layer) { return at(layer).node; }

 private:
  struct Layer {
    Ogre::SceneNode* node = nullptr;
    std::unique_ptr<QuadObject> object;
    QuadMesh mesh;
    std::string frame;
    geometry_msgs::Point origin;
  };
  Layer& at(SceneLayer layer) { return layers_[static_cast<std::size_t>(layer)]; }

  rviz::DisplayContext& context_;
  Ogre::SceneNode* parent_;
  std::array<Layer, static_cast<std::size_t>(SceneLayer::kCount)> layers_;
};

}  // namespace split_mapf
