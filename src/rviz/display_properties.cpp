#include "rviz/display_properties.h"

#include <ros/message_traits.h>

namespace split_mapf {
namespace {

template <class Message>
rviz::RosTopicProperty* makeTopic(rviz::Property* parent, const char* name, const char* topic,
                                  const char* description) {
  return new rviz::RosTopicProperty(name, topic, ros::message_traits::datatype<Message>(),
                                    description, parent);
}

}  // namespace

DisplayProperties::DisplayProperties(rviz::Property* parent)
    : plan(makeTopic<MultiRobotPlan>(parent, "Plan Topic", "/split_mapf/plan",
                                     "The plan to be shown, MultiRobotPlan.")),
      layout(makeTopic<PlanLayout>(parent, "Layout Topic", "/split_mapf/layout",
                                   "Who owned which cells in a space split, PlanLayout.")),
      roadmap(makeTopic<visualization_msgs::MarkerArray>(
          parent, "Roadmap Topic", "/split_mapf/roadmap",
          "The planning graph of robots that have size, as markers.")),
      fleet_state(makeTopic<FleetState>(
          parent, "Fleet State Topic", "",
          "How the execution stands: who is late, who waits for whom. Empty: the plan alone.")),
      progress(makeTopic<RobotProgress>(
          parent, "Progress Topic", "",
          "Where robots say they are: they are shown there. Empty: where the plan has them.")),
      action(new rviz::StringProperty("Action", "/split_mapf/plan_paths",
                                      "The action that is asked for plans, and whose outcomes are "
                                      "shown.",
                                      parent)),
      colour_by(new rviz::EnumProperty("Color By", "Robot",
                                       "Each robot its own colour, or that of its state.", parent)),
      least_size(new rviz::FloatProperty(
          "Least Size", 4, "Robots are shown true to size, but never smaller than this [pixels].",
          parent)),
      trail_steps(new rviz::FloatProperty("Trail", 5, "The last so many steps.", parent)),
      late(new rviz::FloatProperty("Late", 1, "A robot so many seconds behind is late.", parent)),
      goals(new rviz::BoolProperty("Goals", true, "A square where each robot ends.", parent)),
      waits(new rviz::BoolProperty("Waits", true, "A white dot on robots that wait.", parent)),
      labels(new rviz::BoolProperty("Labels", false,
                                    "Ids of the robots in view, as long as they are few.", parent)),
      regions(new rviz::BoolProperty("Regions", false, "The regions of a space split.", parent)),
      phase(new rviz::IntProperty("Phase", 0, "The phase whose regions are shown.", regions)),
      graph(new rviz::BoolProperty("Roadmap", false, "The planning graph.", parent)),
      fit(new rviz::BoolProperty("Fit First Plan", true,
                                 "Moves the view to the map when the first plan comes.", parent)),
      loop(new rviz::BoolProperty("Loop", false, "Start again at the end.", parent)),
      speed(new rviz::FloatProperty("Speed", 0,
                                    "Times the plan's own pace; 0: that pace, or as much faster "
                                    "as lets the plan last a minute.",
                                    parent)) {
  colour_by->addOption("Robot", static_cast<int>(ColourBy::kRobot));
  colour_by->addOption("State", static_cast<int>(ColourBy::kState));
  for (rviz::FloatProperty* number : {least_size, trail_steps, speed}) number->setMin(0);
  least_size->setMax(100);
  trail_steps->setMax(10000);
  speed->setMax(1e6);
  phase->setMin(0);
}

FeedTopics DisplayProperties::topics() const {
  FeedTopics topics;
  topics.plan = plan->getTopicStd();
  topics.layout = layout->getTopicStd();
  topics.roadmap = roadmap->getTopicStd();
  topics.fleet_state = fleet_state->getTopicStd();
  topics.progress = progress->getTopicStd();
  if (!action->getStdString().empty()) topics.result = action->getStdString() + "/result";
  return topics;
}

SceneStyle DisplayProperties::style() const {
  SceneStyle style;
  style.colour_by = static_cast<ColourBy>(colour_by->getOptionInt());
  style.trail_steps = static_cast<double>(trail_steps->getFloat());
  style.waits = waits->getBool();
  style.late_sec = static_cast<double>(late->getFloat());
  return style;
}

}  // namespace split_mapf
