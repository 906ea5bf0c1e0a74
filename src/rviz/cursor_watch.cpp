#include "rviz/cursor_watch.h"

#include <cmath>

#include <OgreCamera.h>
#include <OgrePlane.h>
#include <OgreRay.h>
#include <QEvent>
#include <QMouseEvent>

namespace split_mapf {

CursorWatch::CursorWatch(rviz::RenderPanel& panel) { panel.installEventFilter(this); }

bool CursorWatch::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::MouseMove) {
    place_ = static_cast<QMouseEvent*>(event)->pos();
  } else if (event->type() == QEvent::Leave) {
    place_.reset();
  }
  return QObject::eventFilter(watched, event);
}

std::optional<ScenePoint> groundAt(rviz::RenderPanel& panel, Ogre::SceneNode& node, QPoint place) {
  if (panel.width() <= 0 || panel.height() <= 0 || panel.getCamera() == nullptr) return {};
  const Ogre::Ray ray = panel.getCamera()->getCameraToViewportRay(
      static_cast<float>(place.x()) / static_cast<float>(panel.width()),
      static_cast<float>(place.y()) / static_cast<float>(panel.height()));
  const Ogre::Plane ground(node._getDerivedOrientation() * Ogre::Vector3::UNIT_Z,
                           node._getDerivedPosition());
  const auto hit = ray.intersects(ground);
  if (!hit.first) return {};
  const Ogre::Vector3 point = node.convertWorldToLocalPosition(ray.getPoint(hit.second));
  return ScenePoint{point.x, point.y};
}

float metresPerPixel(rviz::RenderPanel& panel, Ogre::SceneNode& node) {
  const QPoint middle(panel.width() / 2, panel.height() / 2);
  const auto here = groundAt(panel, node, middle);
  const auto beside = groundAt(panel, node, middle + QPoint(1, 0));
  if (!here || !beside) return 0;
  return std::hypot(beside->x - here->x, beside->y - here->y);
}

}  // namespace split_mapf
