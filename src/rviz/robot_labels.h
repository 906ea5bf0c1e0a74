#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <OgreSceneNode.h>
#include <rviz/ogre_helpers/movable_text.h>

#include "ros/scene/plan_scene.h"

namespace split_mapf {

/// Names beside robots. Text is dear to draw, so there are kMost at most. Of the GUI thread.
class RobotLabels {
 public:
  static constexpr std::size_t kMost = 150;

  /// @param parent  in whose coordinates the points are; outlives this object.
  explicit RobotLabels(Ogre::SceneNode* parent) : parent_(parent) {}
  RobotLabels(const RobotLabels&) = delete;
  RobotLabels& operator=(const RobotLabels&) = delete;
  ~RobotLabels();

  /// Takes all labels away; add() puts them anew.
  void begin() { used_ = 0; }
  /// @param size  [m] the height of letters. Returns false when there are kMost already.
  bool add(const std::string& text, ScenePoint point, float size);
  /// Hides the labels that were not used again.
  void end();

 private:
  struct Label {
    Ogre::SceneNode* node;
    std::unique_ptr<rviz::MovableText> text;
    std::string caption;
  };
  Ogre::SceneNode* parent_;
  std::vector<Label> labels_;
  std::size_t used_ = 0;
};

}  // namespace split_mapf
