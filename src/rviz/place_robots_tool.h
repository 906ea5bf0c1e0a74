#pragma once

#include <optional>

#include <rviz/tool.h>

#include "rviz/plan_display.h"

namespace split_mapf {

/// The tool SplitMapf/PlaceRobots: a click on the map places a start, the next one its goal; what
/// is placed can be dragged, and the right button takes a robot away. The panel asks for the plan.
/// Of the GUI thread.
class PlaceRobotsTool : public rviz::Tool {
 public:
  PlaceRobotsTool();

  void onInitialize() override;
  void activate() override;
  void deactivate() override;
  int processMouseEvent(rviz::ViewportMouseEvent& event) override;

 private:
  void press(PlanDisplay& display, ScenePoint point);
  void remove(PlanDisplay& display, ScenePoint point);

  std::optional<RobotDraft::Grip> grip_;  // what is dragged
};

}  // namespace split_mapf
