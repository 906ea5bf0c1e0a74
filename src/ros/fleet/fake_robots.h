#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include <XmlRpcValue.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <ros/wall_timer.h>
#include <split_mapf/MultiRobotPlan.h>
#include <split_mapf/RobotProgress.h>
#include <split_mapf/RobotRoute.h>
#include <tf2_ros/transform_broadcaster.h>
#include <visualization_msgs/MarkerArray.h>

#include "split_mapf/core/delays.h"
#include "split_mapf/core/route_follower.h"

namespace split_mapf {

/// Parameters of the node of robots without hardware.
struct FakeRobotsOptions {
  RobotMotion motion;
  DelayModel delays;
  double delay_step_sec = 1;  ///< that the delay model calls a step
  double rate_hz = 10;        ///< of progress, tf and markers
  double diameter_m = 0;  ///< of the discs that are drawn; 0: the plan's, or four fifths of a cell
  bool publish_tf = true;
  /// Robots that fail, and after how many seconds on their first route.
  std::map<std::string, double> failures;
};

/// @throws OptionError naming the parameter.
FakeRobotsOptions readFakeRobotsOptions(const XmlRpc::XmlRpcValue& parameters);

/// Discs that follow routes, as many as a plan has robots: they appear where a plan on the topic
/// `plan` begins, follow `routes`, and publish `progress`, tf (<robot>/base_link) and ~markers.
/// Delays and failures are seeded. Thread-safe.
class FakeRobots {
 public:
  FakeRobots(ros::NodeHandle node, ros::NodeHandle private_node, const FakeRobotsOptions& options);

 private:
  struct Body {
    std::string id;
    std::string frame;
    std::string plan_id;
    std::optional<RouteFollower> robot;
    ros::Time began;  ///< on its first route
    std::uint8_t status = RobotProgress::OK;
  };

  void takePlan(const MultiRobotPlan& plan);
  void takeRoute(const RobotRoute& route);
  void tick();
  void drive(double seconds);
  void failWhenDue(ros::Time now);
  void publishProgress(ros::Time now);
  void publishTransforms(ros::Time now);
  void publishMarkers(ros::Time now);
  visualization_msgs::Marker markerOf(const char* space, int type, ros::Time now) const;

  FakeRobotsOptions options_;
  std::mutex mutex_;
  std::string frame_ = "map";
  double cell_m_ = 1;
  double disc_m_ = 0;  // of robots that have size
  std::vector<Body> bodies_;
  std::map<std::string, std::size_t> index_;
  std::unique_ptr<Delays> delays_;
  double until_delays_ = 0;
  ros::Time last_;

  tf2_ros::TransformBroadcaster transforms_;
  ros::Publisher progress_;
  ros::Publisher markers_;
  ros::Subscriber plan_;
  ros::Subscriber routes_;
  ros::WallTimer timer_;
};

}  // namespace split_mapf
