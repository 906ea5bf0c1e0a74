#pragma once

#include <memory>

#include <rviz/properties/bool_property.h>
#include <rviz/properties/enum_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/int_property.h>
#include <rviz/properties/ros_topic_property.h>
#include <rviz/properties/string_property.h>

#include "ros/scene/scene_painter.h"
#include "rviz/plan_feed.h"

namespace split_mapf {

/// The rows of a display SplitMapf/Plan in rviz's tree: topics and looks. They belong to their
/// parent, the display.
class DisplayProperties {
 public:
  /// @param parent  the display, which outlives this object.
  explicit DisplayProperties(rviz::Property* parent);

  FeedTopics topics() const;
  /// Without the least radius, which the view knows.
  SceneStyle style() const;

  rviz::RosTopicProperty* plan;
  rviz::RosTopicProperty* layout;
  rviz::RosTopicProperty* roadmap;
  rviz::RosTopicProperty* fleet_state;
  rviz::RosTopicProperty* progress;
  rviz::StringProperty* action;

  rviz::EnumProperty* colour_by;
  rviz::FloatProperty* least_size;  ///< [pixels]
  rviz::FloatProperty* trail_steps;
  rviz::FloatProperty* late;  ///< [s]
  rviz::BoolProperty* goals;
  rviz::BoolProperty* waits;
  rviz::BoolProperty* labels;
  rviz::BoolProperty* regions;
  rviz::IntProperty* phase;
  rviz::BoolProperty* graph;
  rviz::BoolProperty* fit;
  rviz::BoolProperty* loop;
  rviz::FloatProperty* speed;
};

}  // namespace split_mapf
