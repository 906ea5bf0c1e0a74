// What a display SplitMapf/Plan draws of its plan, and how it moves the view.

#include <algorithm>
#include <cmath>
#include <string>

#include <OgreCamera.h>
#include <rviz/display_context.h>
#include <rviz/geometry.h>
#include <rviz/visualization_manager.h>
#include <QToolTip>

#include "rviz/plan_display.h"
#include "rviz/view_control.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

using rviz::StatusProperty;

constexpr float kReachPixels = 5;   // a mouse need not be more exact
constexpr float kLabelPixels = 13;  // height of letters
constexpr float kPlacedPixels = 7;  // least radius of what is placed
constexpr float kRing = 1.5F;       // of a robot's radius, around the followed one
const PackedColour followed_colour = packed(0.95F, 0.2F, 0.65F, 0.8F);
const PackedColour pointed_at_colour = packed(0.1F, 0.1F, 0.1F, 0.6F);

}  // namespace

void PlanDisplay::followFrames() {
  const std::string lost = layers_->follow();
  if (lost.empty()) {
    deleteStatus("Frame");
  } else {
    setStatusStd(StatusProperty::Error, "Frame",
                 "no transform from frame " + quote(lost) + " to " + fixed_frame_.toStdString());
  }
  if (!scene_ || !followed_) return;
  const ScenePoint place = fleet_.place(*scene_, *followed_, timeline_.position());
  lookAt(*manager(),
         layers_->node(SceneLayer::kRobots)->convertLocalToWorldPosition({place.x, place.y, 0}));
}

void PlanDisplay::fitToMap() {
  if (!scene_ || manager() == nullptr) return;
  const nav_msgs::MapMetaData& map = scene_->geometry().info();
  const double yaw = scene_->geometry().yaw();
  const double width = double{map.resolution} * map.width;
  const double height = double{map.resolution} * map.height;
  const double cos = std::cos(yaw);
  const double sin = std::sin(yaw);
  const Ogre::Vector3 middle(static_cast<float>((cos * width - sin * height) / 2),
                             static_cast<float>((sin * width + cos * height) / 2), 0);
  fitView(*manager(), layers_->node(SceneLayer::kRobots)->convertLocalToWorldPosition(middle),
          static_cast<float>(std::abs(cos) * width + std::abs(sin) * height),
          static_cast<float>(std::abs(sin) * width + std::abs(cos) * height));
}

void PlanDisplay::follow(std::optional<std::size_t> robot) {
  followed_ = robot;
  changed_ = true;
}

void PlanDisplay::repaint() {
  rviz::RenderPanel* panel = manager() == nullptr ? nullptr : manager()->getRenderPanel();
  if (panel != nullptr) {
    const float scale = metresPerPixel(*panel, *layers_->node(SceneLayer::kRobots));
    changed_ = changed_ || scale != metres_per_pixel_;
    metres_per_pixel_ = scale;
  }
  if (changed_ || placed_changed_ || timeline_.position() != shown_step_) {
    SceneStyle style = properties_->style();
    style.least_radius_m = properties_->least_size->getFloat() / 2 * metres_per_pixel_;
    // Only a view of parallel rays has one scale.
    const bool parallel =
        panel != nullptr && panel->getCamera()->getProjectionType() == Ogre::PT_ORTHOGRAPHIC;
    style.pixel_m = parallel ? metres_per_pixel_ : 0;
    if (scene_) {
      paintRobots(moment(), style, layers_->begin(SceneLayer::kRobots));
      layers_->present(SceneLayer::kRobots);
      paintWaits(moment(), style, layers_->begin(SceneLayer::kWaits));
      layers_->present(SceneLayer::kWaits);
      paintTrails(moment(), style, layers_->begin(SceneLayer::kTrails));
      layers_->present(SceneLayer::kTrails);
    }
    if (scene_ && changed_) {
      QuadMesh& goals = layers_->begin(SceneLayer::kGoals);
      if (properties_->goals->getBool()) paintGoals(moment(), style, goals);
      layers_->present(SceneLayer::kGoals);
    }
    paintMarks(style);
    paintPlaced();
  }
  label();
  shown_step_ = timeline_.position();
  changed_ = placed_changed_ = false;
}

void PlanDisplay::paintMarks(const SceneStyle& style) {
  QuadMesh& marks = layers_->begin(SceneLayer::kMarks);
  const auto ring = [&](std::size_t robot, PackedColour colour) {
    marks.addDisc(fleet_.place(*scene_, robot, timeline_.position()),
                  kRing * shownRadius(*scene_, robot, style), 0, withAlpha(colour, 0.45F));
  };
  if (scene_ && followed_) ring(*followed_, followed_colour);
  if (scene_ && pointed_at_) ring(*pointed_at_, pointed_at_colour);
  layers_->present(SceneLayer::kMarks);
}

void PlanDisplay::paintPlaced() {
  placed_.paint(placedRadius(), layers_->begin(SceneLayer::kDraft));
  layers_->attach(SceneLayer::kDraft, placed_.frame(), placed_.origin());
  layers_->present(SceneLayer::kDraft);
}

void PlanDisplay::label() {
  labels_->begin();
  rviz::RenderPanel* panel = manager() == nullptr ? nullptr : manager()->getRenderPanel();
  if (scene_ && panel != nullptr && properties_->labels->getBool()) {
    Ogre::SceneNode& node = *layers_->node(SceneLayer::kRobots);
    for (std::size_t robot = 0; robot < scene_->robots(); ++robot) {
      const ScenePoint place = fleet_.place(*scene_, robot, timeline_.position());
      const Ogre::Vector2 pixel = rviz::project3DPointToViewportXY(
          panel->getViewport(), node.convertLocalToWorldPosition({place.x, place.y, 0}));
      if (pixel.x < 0 || pixel.y < 0 || pixel.x > static_cast<float>(panel->width()) ||
          pixel.y > static_cast<float>(panel->height())) {
        continue;
      }
      if (!labels_->add(shown(scene_->id(robot)), place, kLabelPixels * metres_per_pixel_)) break;
    }
  }
  labels_->end();
}

void PlanDisplay::watchCursor() {
  if (!cursor_) return;
  rviz::RenderPanel& panel = *manager()->getRenderPanel();
  const std::optional<QPoint> place = cursor_->place();
  std::optional<ScenePoint> ground;
  if (place) ground = groundAt(panel, *layers_->node(SceneLayer::kRobots), *place);
  const std::optional<std::size_t> before = pointed_at_;
  SceneStyle style = properties_->style();
  style.least_radius_m = properties_->least_size->getFloat() / 2 * metres_per_pixel_;
  pointed_at_.reset();
  if (ground) {
    pointed_at_ = robotNear(moment(), *ground, kReachPixels * metres_per_pixel_, style);
  }
  if (pointed_at_ != before) changed_ = true;
  if (place && pointed_at_) {
    QToolTip::showText(panel.mapToGlobal(*place),
                       QString::fromStdString(describe(moment(), *pointed_at_, style.late_sec)),
                       &panel);
  } else if (before) {
    QToolTip::hideText();
  }
}

std::optional<ScenePoint> PlanDisplay::placeAt(QPoint place) {
  if (manager() == nullptr || manager()->getRenderPanel() == nullptr) return std::nullopt;
  if (placed_.all().empty()) {
    if (scene_) {
      placed_.begin(scene_->geometry().frame(), scene_->geometry().info().origin.position);
    } else {
      placed_.begin(fixed_frame_.toStdString(), geometry_msgs::Point());
    }
  }
  // Robots of a plan may have been taken over since, with the plan's frame.
  layers_->attach(SceneLayer::kDraft, placed_.frame(), placed_.origin());
  layers_->follow();
  return groundAt(*manager()->getRenderPanel(), *layers_->node(SceneLayer::kDraft), place);
}

float PlanDisplay::placedRadius() const {
  const float size = scene_ && scene_->robots() > 0 ? scene_->radius(0) : 0;
  return std::max(size, kPlacedPixels * metres_per_pixel_);
}

}  // namespace split_mapf
