#pragma once

#include <string>

#include <geometry_msgs/Quaternion.h>

namespace split_mapf {

/// Whether the quaternion is finite and of length 1, within 1 %.
bool isUnitQuaternion(const geometry_msgs::Quaternion& q);
/// Whether the quaternion is all zero, as in a message that nobody filled: no heading.
bool isAllZero(const geometry_msgs::Quaternion& q);
/// Rotation about z [rad]. @pre isUnitQuaternion(q).
double yawOf(const geometry_msgs::Quaternion& q);
/// The rotation about z by `yaw` [rad].
geometry_msgs::Quaternion quaternionOf(double yaw);
/// A frame name without the leading slash that tf had and tf2 refuses.
std::string stripSlash(const std::string& frame_id);

}  // namespace split_mapf
