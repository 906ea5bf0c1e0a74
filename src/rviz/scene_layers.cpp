#include "rviz/scene_layers.h"

#include <OgreRenderQueue.h>
#include <OgreSceneManager.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>

namespace split_mapf {
namespace {

// Maps are drawn at the main queue's place or before it.
constexpr std::uint8_t kFirstQueue = Ogre::RENDER_QUEUE_MAIN + 1;
// [m] Above the map and each other, as far as the depth of a picture tells them apart.
constexpr float kLift = 0.004F;

bool hasDiscs(SceneLayer layer) {
  return layer != SceneLayer::kLayout && layer != SceneLayer::kTrails &&
         layer != SceneLayer::kGoals;
}

}  // namespace

SceneLayers::SceneLayers(rviz::DisplayContext& context, Ogre::SceneNode* parent)
    : context_(context), parent_(parent) {
  std::uint8_t queue = kFirstQueue;
  for (std::size_t k = 0; k < layers_.size(); ++k) {
    Layer& layer = layers_[k];
    layer.node = parent_->createChildSceneNode();
    layer.object = std::make_unique<QuadObject>(hasDiscs(static_cast<SceneLayer>(k)));
    layer.object->setRenderQueueGroup(queue++);
    layer.node->attachObject(layer.object.get());
  }
}

SceneLayers::~SceneLayers() {
  for (Layer& layer : layers_) {
    layer.node->detachAllObjects();
    parent_->getCreator()->destroySceneNode(layer.node);
  }
}

QuadMesh& SceneLayers::begin(SceneLayer layer) {
  at(layer).mesh.clear();
  return at(layer).mesh;
}

void SceneLayers::hide(SceneLayer layer) {
  begin(layer);
  present(layer);
}

void SceneLayers::attach(SceneLayer layer, const std::string& frame,
                         const geometry_msgs::Point& origin) {
  at(layer).frame = frame;
  at(layer).origin = origin;
}

std::string SceneLayers::follow() {
  std::string lost;
  float lift = kLift;
  for (Layer& layer : layers_) {
    lift += kLift;
    if (layer.frame.empty()) continue;
    geometry_msgs::Pose pose;
    pose.position = layer.origin;
    pose.position.z += lift;
    pose.orientation.w = 1;
    Ogre::Vector3 position;
    Ogre::Quaternion orientation;
    const bool known = context_.getFrameManager()->transform(layer.frame, ros::Time(), pose,
                                                             position, orientation);
    // The pose holds the origin; points are along the axes of the frame.
    layer.node->setVisible(known && !layer.mesh.corners().empty());
    if (known) {
      layer.node->setPosition(position);
      layer.node->setOrientation(orientation);
    } else if (lost.empty()) {
      lost = layer.frame;
    }
  }
  return lost;
}

}  // namespace split_mapf
