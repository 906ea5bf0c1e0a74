#pragma once

#include <memory>

#include <ros/node_handle.h>

#include "ros/server/goal_defaults.h"
#include "split_mapf/pipeline/planner.h"

namespace split_mapf {

/// Lets the defaults of goals be changed while the node runs, by dynamic_reconfigure (cfg/
/// Planner.cfg): for the next goal, never for one that is there. What the options themselves would
/// refuse is refused as a whole, with an error in the log, and the old values are shown again.
/// Another solver leaves the options of the one before behind, another split those of the split, on
/// the parameter server too: the next node starts with what holds now.
/// Without dynamic_reconfigure in the build it does nothing.
class Reconfiguration {
 public:
  /// @pre both outlive this object. The defaults as they are now are put on the parameter server.
  Reconfiguration(const ros::NodeHandle& private_node, const Planner& planner,
                  GoalDefaults& defaults);
  ~Reconfiguration();
  Reconfiguration(const Reconfiguration&) = delete;
  Reconfiguration& operator=(const Reconfiguration&) = delete;

 private:
  struct Server;
  std::unique_ptr<Server> server_;
};

}  // namespace split_mapf
