#include "rviz/robot_labels.h"

#include <cstdint>

#include <OgreRenderQueue.h>
#include <OgreSceneManager.h>

namespace split_mapf {
namespace {

// Behind the layers of robots, and before what rviz draws over everything.
constexpr std::uint8_t kAboveRobots = Ogre::RENDER_QUEUE_MAIN + 15;

}  // namespace

RobotLabels::~RobotLabels() {
  for (Label& label : labels_) {
    label.node->detachAllObjects();
    parent_->getCreator()->destroySceneNode(label.node);
  }
}

bool RobotLabels::add(const std::string& text, ScenePoint point, float size) {
  if (used_ == kMost) return false;
  // An empty text cannot be drawn.
  const std::string caption = text.empty() ? " " : text;
  if (used_ == labels_.size()) {
    Label& fresh = labels_.emplace_back();
    fresh.node = parent_->createChildSceneNode();
    fresh.text = std::make_unique<rviz::MovableText>(caption, "Liberation Sans", size,
                                                     Ogre::ColourValue(0.1F, 0.1F, 0.1F));
    fresh.caption = caption;
    fresh.text->setTextAlignment(rviz::MovableText::H_CENTER, rviz::MovableText::V_ABOVE);
    fresh.text->setRenderQueueGroup(kAboveRobots);
    fresh.node->attachObject(fresh.text.get());
  }
  Label& label = labels_[used_++];
  if (label.caption != caption) {
    label.caption = caption;
    label.text->setCaption(caption);
  }
  label.text->setCharacterHeight(size);
  label.node->setPosition(point.x, point.y, 0);
  label.node->setVisible(true);
  return true;
}

void RobotLabels::end() {
  for (std::size_t k = used_; k < labels_.size(); ++k) labels_[k].node->setVisible(false);
}

}  // namespace split_mapf
