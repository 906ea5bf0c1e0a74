#include "rviz/view_control.h"

#include <algorithm>
#include <cmath>

#include <OgreCamera.h>
#include <rviz/properties/property.h>
#include <rviz/render_panel.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <rviz/visualization_manager.h>
#include <QStringList>

namespace split_mapf {
namespace {

constexpr float kRim = 1.06F;  // a little of what is around

bool has(rviz::Property& properties, const QString& name) {
  for (int row = 0; row < properties.numChildren(); ++row) {
    if (properties.childAt(row)->getName() == name) return true;
  }
  return false;
}

}  // namespace

void lookAt(rviz::VisualizationManager& manager, const Ogre::Vector3& point) {
  rviz::ViewController* view = manager.getViewManager()->getCurrent();
  if (view == nullptr) return;
  if (has(*view, "Scale")) {
    // lookAt() of this kind of view keeps its distance to what it looked at before.
    view->subProp("X")->setValue(point.x);
    view->subProp("Y")->setValue(point.y);
  } else {
    view->lookAt(point);
  }
}

void fitView(rviz::VisualizationManager& manager, const Ogre::Vector3& middle, float width,
             float height) {
  rviz::ViewManager* views = manager.getViewManager();
  const rviz::RenderPanel& panel = *manager.getRenderPanel();
  rviz::ViewController* view = views->getCurrent();
  if (view == nullptr || !(has(*view, "Scale") || has(*view, "Distance"))) {
    views->setCurrentViewControllerType("rviz/TopDownOrtho");
    view = views->getCurrent();
  }
  const float pixels_wide = std::max(1.0F, static_cast<float>(panel.width()));
  const float pixels_high = std::max(1.0F, static_cast<float>(panel.height()));
  if (has(*view, "Scale")) {
    const float scale = std::min(pixels_wide / width, pixels_high / height) / kRim;
    view->subProp("Scale")->setValue(scale);
  } else {
    const float half_view = panel.getCamera()->getFOVy().valueRadians() / 2;
    const float needed = std::max(height, width * pixels_high / pixels_wide);
    view->subProp("Distance")->setValue(kRim * needed / 2 / std::tan(half_view));
  }
  lookAt(manager, middle);
}

}  // namespace split_mapf
