#pragma once

#include <cstdint>

#include <ros/node_handle.h>
#include <ros/wall_timer.h>

#include "ros/server/plan_server.h"

namespace split_mapf {

/// Keeps the allocator from spreading what goals leave behind over an arena a thread, and from
/// keeping large blocks that were freed. Call before threads are started. Without effect where the
/// C library is not glibc.
void limitArenas(std::uint32_t arenas);

/// Gives memory that goals have freed back to the system: the allocator would keep it, as much as
/// the largest goals together took. Looks twice a second whether goals have ended since.
class MemoryReturn {
 public:
  /// @pre server outlives this object.
  MemoryReturn(const ros::NodeHandle& node, const PlanServer& server);

 private:
  void look();

  const PlanServer& server_;
  std::uint64_t seen_ = 0;  ///< goals that had ended when memory was given back
  std::uint32_t looks_ = 0;
  ros::WallTimer timer_;
};

}  // namespace split_mapf
