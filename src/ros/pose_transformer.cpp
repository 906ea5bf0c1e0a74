#include "split_mapf/ros/pose_transformer.h"

#include <chrono>
#include <optional>
#include <thread>

#include <tf2/exceptions.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

#include "split_mapf/ros/orientation.h"

namespace split_mapf {

PoseTransform PoseTransformer::forGoal(const Deadline& deadline) const {
  std::optional<Deadline> patience;
  return [this, deadline, patience](const geometry_msgs::PoseStamped& pose,
                                    const std::string& frame) mutable {
    // The clock of the patience is the wall's: a simulated one may stand still.
    if (!patience) patience = deadline.within(kPatienceSec);
    const std::string from = stripSlash(pose.header.frame_id);
    const ros::Time& stamp = pose.header.stamp;
    while (!buffer_.canTransform(frame, from, stamp) && !patience->expired()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    const geometry_msgs::TransformStamped transform = buffer_.lookupTransform(frame, from, stamp);
    geometry_msgs::PoseStamped transformed;
    tf2::doTransform(pose, transformed, transform);
    return transformed.pose.position;
  };
}

}  // namespace split_mapf
