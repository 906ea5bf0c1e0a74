#include "split_mapf/ros/orientation.h"

#include <cmath>

namespace split_mapf {

bool isUnitQuaternion(const geometry_msgs::Quaternion& q) {
  const double length = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  return std::isfinite(length) && std::abs(length - 1) <= 0.01;
}

bool isAllZero(const geometry_msgs::Quaternion& q) {
  return q.x == 0 && q.y == 0 && q.z == 0 && q.w == 0;
}

double yawOf(const geometry_msgs::Quaternion& q) {
  return std::atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z));
}

geometry_msgs::Quaternion quaternionOf(double yaw) {
  geometry_msgs::Quaternion q;
  q.z = std::sin(yaw / 2);
  q.w = std::cos(yaw / 2);
  return q;
}

std::string stripSlash(const std::string& frame_id) {
  return !frame_id.empty() && frame_id.front() == '/' ? frame_id.substr(1) : frame_id;
}

}  // namespace split_mapf
