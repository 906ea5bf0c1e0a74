#pragma once

namespace split_mapf {

/// Takes over the ways in which a node is told to end (SIGINT, SIGTERM, `rosnode kill`), so that it
/// can finish its work while it still has its connections. roscpp's own handlers cut those first.
/// Call after ros::init with NoSigintHandler and after ros::start (the first node handle).
void installEndSignal();
/// Whether the node was told to end, or ROS has ended.
bool endSignalled();
/// Returns once endSignalled(), within 20 ms.
void waitForEndSignal();

}  // namespace split_mapf
