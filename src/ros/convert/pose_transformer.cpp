#include "ros/convert/pose_transformer.h"

#include <chrono>
#include <exception>
#include <optional>
#include <thread>

#include <geometry_msgs/PointStamped.h>
#include <tf2/exceptions.h>
#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

#include "split_mapf/core/wording.h"
#include "split_mapf/ros/orientation.h"

namespace split_mapf {
namespace {

std::string knowsNot(const std::string& frame) { return "nobody publishes frame " + quote(frame); }

}  // namespace

PoseTransform PoseTransformer::forGoal(const Deadline& deadline) const {
  std::optional<Deadline> patience;
  return [this, deadline, patience](const geometry_msgs::PoseStamped& pose,
                                    const std::string& frame) mutable {
    // The clock of the patience is the wall's: a simulated one may stand still.
    if (!patience) patience = deadline.within(kPatienceSec);
    const std::string from = stripSlash(pose.header.frame_id);
    if (from.front() == '/') {
      throw TransformFailure("a frame's name begins with no more than one slash");
    }
    try {
      return transformed(pose, from, frame, *patience);
    } catch (const std::exception& error) {
      throw TransformFailure(reason(error, pose, from, frame) +
                             " (tf2 says: " + shown(error.what()) + ")");
    }
  };
}

geometry_msgs::Point PoseTransformer::transformed(const geometry_msgs::PoseStamped& pose,
                                                  const std::string& from, const std::string& into,
                                                  const Deadline& patience) const {
  const ros::Time& stamp = pose.header.stamp;
  while (!buffer_.canTransform(into, from, stamp) && !patience.expired()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  const geometry_msgs::TransformStamped transform = buffer_.lookupTransform(into, from, stamp);
  // The heading is not used, and may be none.
  geometry_msgs::PointStamped point;
  point.header = pose.header;
  point.point = pose.pose.position;
  geometry_msgs::PointStamped there;
  tf2::doTransform(point, there, transform);
  return there.point;
}

std::string PoseTransformer::reason(const std::exception& error,
                                    const geometry_msgs::PoseStamped& pose, const std::string& from,
                                    const std::string& into) const {
  const std::string waited = ", waited up to " + numeral(kPatienceSec) + " s";
  if (!buffer_._frameExists(from)) return knowsNot(from) + waited;
  if (!buffer_._frameExists(into)) return knowsNot(into) + waited;
  if (dynamic_cast<const tf2::ConnectivityException*>(&error) != nullptr) {
    return "both frames are published, but no chain of transforms joins them" + waited;
  }
  return "there is no transform at the pose's time stamp of " +
         std::to_string(pose.header.stamp.sec) + " s; a stamp of zero asks for the latest" + waited;
}

}  // namespace split_mapf
