#pragma once

#include <cstddef>
#include <mutex>
#include <optional>
#include <string>

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/service_server.h>
#include <ros/subscriber.h>
#include <ros/wall_timer.h>
#include <split_mapf/MultiRobotPlan.h>
#include <split_mapf/PlanLayout.h>
#include <split_mapf/ReplayControl.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "ros/replay/replay_clock.h"
#include "ros/replay/replay_timeline.h"
#include "split_mapf/ros/markers.h"

namespace split_mapf {

/// Parameters of the replay node.
struct ReplayOptions {
  MarkerStyle style;
  double rate_hz = 20;  ///< markers a second of wall time, at most
  /// Times the plan's own pace; 0: that pace, or as much faster as lets a plan last a minute.
  double speed = 0;
  bool loop = false;             ///< start again at the end
  bool wait_for_viewer = false;  ///< stand until somebody has subscribed ~markers for a moment
  /// A frame at the grid's origin, told by tf so that viewers know the plan's frame; empty: none.
  std::string grid_frame = "split_mapf_grid";
};

/// Reads ~robot_size, ~trail_steps, ~show_goals, ~show_labels, ~rate, ~speed, ~loop,
/// ~wait_for_viewer and ~grid_frame.
/// @throws OptionError naming the parameter.
ReplayOptions readReplayOptions(const XmlRpc::XmlRpcValue& parameters);

/// Shows plans as moving markers: subscribes `plan`, `planning_grid` and `layout`, publishes
/// ~markers and ~layout_markers (latched) and a frame at the grid's origin, serves ~control. Robots
/// go out with every message, trails a few times a second, goals once a plan, a viewer and some
/// seconds. A new plan starts at once, at its step 0, and the one that is shown starts again when
/// ROS time begins or jumps back. Paced by ROS time; by wall time where time is simulated and
/// nobody publishes the clock. Thread-safe.
class Replay {
 public:
  Replay(ros::NodeHandle node, ros::NodeHandle private_node, const ReplayOptions& options);

 private:
  void takePlan(const MultiRobotPlan& plan);
  void takeLayout(const PlanLayout& layout);
  void takeGrid(const nav_msgs::OccupancyGrid& grid);
  bool control(ReplayControl::Request& request, ReplayControl::Response& response);
  /// Carries a command out and says what was done. @throws InputError.
  std::string obey(const ReplayControl::Request& request);
  void tick();
  void moveLocked(ros::Time now);
  /// Whether whoever opened a viewer has had the time to see something.
  bool isWatchedLocked();
  /// Which markers have to go out now besides the robots.
  MarkerParts duePartsLocked(bool moves) const;
  void publishLocked(MarkerParts parts);
  void tellFrameLocked(const MultiRobotPlan& plan);
  /// Warns when the plan was made on another grid than the one that is shown.
  void compareGridsLocked();

  ReplayOptions options_;
  std::mutex mutex_;
  ReplayClock clock_;
  ReplayTimeline timeline_;
  std::optional<PlanMarkers> markers_;
  std::optional<nav_msgs::MapMetaData> plan_grid_;
  std::optional<nav_msgs::MapMetaData> shown_grid_;
  ros::WallTime compare_at_;  ///< when plan and grid should both have arrived; zero: done
  ros::Time last_tick_;
  std::optional<ros::SteadyTime> watched_since_;
  std::optional<double> shown_position_;
  std::optional<double> trails_position_;  ///< with which trails went out last
  std::optional<double> goals_position_;   ///< likewise goals
  ros::SteadyTime trails_at_;
  ros::SteadyTime goals_at_;
  std::size_t shown_labels_ = 0;

  tf2_ros::StaticTransformBroadcaster broadcaster_;
  ros::Publisher publisher_;
  ros::Publisher layout_publisher_;
  ros::Subscriber plan_subscriber_;
  ros::Subscriber grid_subscriber_;
  ros::Subscriber layout_subscriber_;
  ros::ServiceServer control_;
  ros::WallTimer timer_;
};

}  // namespace split_mapf
