#pragma once

#include <cstdint>
#include <string>

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>

#include "ros/server/plan_server.h"
#include "workers/workers.h"

namespace split_mapf {

/// Publishes on /diagnostics once a second: queue, workers, last outcome, memory. The log has it,
/// too, when workers elsewhere cannot be asked, and when they can be again.
class ServerDiagnostics {
 public:
  /// @param workers  threads of this process. @param remote  null: none are asked for.
  /// @pre server and remote workers outlive this object.
  ServerDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                    const PlanServer& server, QueueLimits limits, std::uint32_t workers,
                    const RemoteWorkers* remote);

 private:
  void fill(diagnostic_updater::DiagnosticStatusWrapper& status);
  /// Why nobody elsewhere can be asked; empty: somebody can, or none are asked for.
  std::string troubleElsewhere();

  const PlanServer& server_;
  const QueueLimits limits_;
  const std::uint32_t workers_;
  const RemoteWorkers* const remote_;
  std::string trouble_;  ///< that was told last
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace split_mapf
