#pragma once

#include <functional>
#include <optional>

#include <OgreSceneNode.h>
#include <rviz/render_panel.h>
#include <QObject>
#include <QPoint>

#include "ros/scene/plan_scene.h"

namespace split_mapf {

/// Where the mouse is over the 3D view, whatever tool is chosen. Of the GUI thread.
class CursorWatch : public QObject {
 public:
  /// @param panel  outlives this object.
  explicit CursorWatch(rviz::RenderPanel& panel);

  /// [pixels] of the view; empty: the mouse is elsewhere.
  std::optional<QPoint> place() const { return place_; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  std::optional<QPoint> place_;
};

/// The point of a node's ground (z = 0 in its coordinates) that is seen at a place of the view
/// [pixels].
std::optional<ScenePoint> groundAt(rviz::RenderPanel& panel, Ogre::SceneNode& node, QPoint place);
/// [m] that a pixel covers on a node's ground, at the middle of the view.
float metresPerPixel(rviz::RenderPanel& panel, Ogre::SceneNode& node);

}  // namespace split_mapf
