// What rviz finds in this library, as plugin_description.xml names it.

#include <rviz/display.h>
#include <rviz/panel.h>
#include <rviz/tool.h>
#include <pluginlib/class_list_macros.hpp>

#include "rviz/place_robots_tool.h"
#include "rviz/plan_display.h"
#include "rviz/player_panel.h"

PLUGINLIB_EXPORT_CLASS(split_mapf::PlanDisplay, rviz::Display)
PLUGINLIB_EXPORT_CLASS(split_mapf::PlayerPanel, rviz::Panel)
PLUGINLIB_EXPORT_CLASS(split_mapf::PlaceRobotsTool, rviz::Tool)
