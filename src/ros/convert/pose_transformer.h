#pragma once

#include <exception>
#include <functional>
#include <stdexcept>
#include <string>

#include <geometry_msgs/Point.h>
#include <geometry_msgs/PoseStamped.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include "split_mapf/core/deadline.h"

namespace split_mapf {

/// Why a pose cannot be transformed: half a sentence for people, and what tf2 said.
class TransformFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The position of a pose in another frame. The pose's orientation is not read.
/// @throws TransformFailure.
using PoseTransform = std::function<geometry_msgs::Point(const geometry_msgs::PoseStamped&,
                                                         const std::string& frame)>;

/// Listens to tf and transforms poses. Thread-safe.
class PoseTransformer {
 public:
  /// How long a goal as a whole waits for transforms that have not arrived yet [s].
  static constexpr double kPatienceSec = 1.0;

  PoseTransformer() : listener_(buffer_) {}

  /// A transform for one goal, which shares out the patience among its poses and gives up when
  /// `deadline` expires. @pre this object outlives it.
  PoseTransform forGoal(const Deadline& deadline) const;

 private:
  geometry_msgs::Point transformed(const geometry_msgs::PoseStamped& pose, const std::string& from,
                                   const std::string& into, const Deadline& patience) const;
  std::string reason(const std::exception& error, const geometry_msgs::PoseStamped& pose,
                     const std::string& from, const std::string& into) const;

  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
};

}  // namespace split_mapf
