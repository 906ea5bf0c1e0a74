#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>

#include "ros/fleet/fleet_server.h"

namespace split_mapf {

/// Publishes on /diagnostics once a second how an execution stands, and what is wrong with it.
class FleetDiagnostics {
 public:
  /// @pre the server outlives this object.
  FleetDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                   const FleetServer& server);

 private:
  void fill(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  const FleetServer& server_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace split_mapf
