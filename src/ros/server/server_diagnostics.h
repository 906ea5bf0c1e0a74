#pragma once

#include <cstdint>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>

#include "ros/server/plan_server.h"

namespace split_mapf {

/// Publishes on /diagnostics once a second: queue, workers, last outcome, memory.
class ServerDiagnostics {
 public:
  /// @pre the server outlives this object.
  ServerDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                    const PlanServer& server, QueueLimits limits, std::uint32_t workers);

 private:
  void fill(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  const PlanServer& server_;
  const QueueLimits limits_;
  const std::uint32_t workers_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace split_mapf
