#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <XmlRpcValue.h>
#include <ros/ros.h>

namespace split_mapf {

/// What a node is made of, once ROS has begun.
struct NodeContext {
  ros::NodeHandle node;
  ros::NodeHandle private_node{"~"};
  XmlRpc::XmlRpcValue parameters;  ///< all of `~`
};

/// Serves callbacks in so many threads until the node is told to end.
/// @param ready  is logged when they run.
/// @param end  called when the node is told to end, while results can still leave it; null: there
/// is nothing to do then.
void serve(std::uint32_t threads, const std::string& ready,
           const std::function<void()>& end = nullptr);

/// The main() of a node: begins ROS under a name, runs, ends ROS. Returns the exit code:
/// anything thrown is told in the log and ends the process with 1.
int runNode(int argc, char** argv, const char* name, void (*run)(NodeContext&));

}  // namespace split_mapf
