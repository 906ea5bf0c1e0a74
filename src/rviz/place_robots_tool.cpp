#include "rviz/place_robots_tool.h"

#include <rviz/display_context.h>
#include <rviz/load_resource.h>
#include <rviz/viewport_mouse_event.h>

namespace split_mapf {

PlaceRobotsTool::PlaceRobotsTool() { shortcut_key_ = 'r'; }

void PlaceRobotsTool::onInitialize() {
  setName("Place Robots");
  setIcon(rviz::loadPixmap("package://rviz/icons/classes/SetGoal.png"));
}

void PlaceRobotsTool::activate() {
  grip_.reset();
  setStatus("Click: a start, then its goal. Drag: move. Right button: take a robot away.");
}

void PlaceRobotsTool::deactivate() { grip_.reset(); }

int PlaceRobotsTool::processMouseEvent(rviz::ViewportMouseEvent& event) {
  PlanDisplay* display = PlanDisplay::find(*context_);
  if (display == nullptr) {
    setStatus("Add a display SplitMapf/Plan first.");
    return 0;
  }
  if (event.leftUp()) grip_.reset();
  // All may have been taken away or over meanwhile.
  if (grip_ && grip_->robot >= display->placed().all().size()) grip_.reset();
  if (!event.leftDown() && !event.rightDown() && !(event.left() && grip_)) return 0;
  const std::optional<ScenePoint> point = display->placeAt(QPoint(event.x, event.y));
  if (!point) return 0;
  if (event.leftDown()) {
    press(*display, *point);
  } else if (event.rightDown()) {
    remove(*display, *point);
  } else {
    display->placed().move(*grip_, *point);
  }
  display->placedChanged();
  return Render;
}

void PlaceRobotsTool::press(PlanDisplay& display, ScenePoint point) {
  grip_ = display.placed().near(point, display.placedRadius());
  if (!grip_) grip_ = display.placed().add(point);
}

void PlaceRobotsTool::remove(PlanDisplay& display, ScenePoint point) {
  const auto found = display.placed().near(point, display.placedRadius());
  if (found) display.placed().remove(found->robot);
  grip_.reset();
}

}  // namespace split_mapf
