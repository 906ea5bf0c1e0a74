// The misbehaving plug-ins as a library, for programs that load them.
#ifndef PLUGINS_WITHOUT_ROS
#include <pluginlib/class_list_macros.hpp>
#endif

#include "plugin/misbehaving_plugin.h"
#include "split_mapf/plugin/export_plugins.h"

SPLIT_MAPF_EXPORT_PLUGINS(split_mapf::test::MisbehavingSolver,
                          split_mapf::test::MisbehavingSplitter)
#ifndef PLUGINS_WITHOUT_ROS
PLUGINLIB_EXPORT_CLASS(split_mapf::test::MisbehavingSolver, split_mapf::SolverPlugin)
PLUGINLIB_EXPORT_CLASS(split_mapf::test::MisbehavingSplitter, split_mapf::SplitterPlugin)
#endif
