#include "ros/replay/replay.h"

#include <cmath>
#include <cstdio>
#include <exception>
#include <string>

#include <geometry_msgs/TransformStamped.h>
#include <ros/console.h>
#include <ros/topic_manager.h>

#include "ros/convert/parameter_reader.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/ros/layout_messages.h"
#include "split_mapf/ros/orientation.h"

namespace split_mapf {
namespace {

// Plan and grid come on two topics, in any order.
constexpr double kComparisonDelaySec = 1.0;
// rviz subscribes some time before it draws for the first time.
constexpr double kFirstLookSec = 3.0;
// Robots cover the end of a trail that is a little late; most of a message would be trails.
constexpr double kTrailsSec = 0.25;
// Whoever missed the goals, as a player of a bag may have, sees them after this time.
constexpr double kGoalsSec = 5.0;

void requireAtLeast(double least, const char* name, double value) {
  if (!std::isfinite(value) || value < least) {
    throw OptionError("parameter ~" + std::string(name) + " is " + numeral(value) +
                      "; a number >= " + numeral(least) + " is expected");
  }
}

bool sameCells(const nav_msgs::MapMetaData& a, const nav_msgs::MapMetaData& b) {
  return a.width == b.width && a.height == b.height && a.resolution == b.resolution;
}

ClockReading readClocks(ros::Time now) {
  ClockReading reading;
  reading.ros_sec = now.toSec();
  reading.wall_sec = ros::SteadyTime::now().toSec();
  reading.driven =
      !ros::Time::isSimTime() || ros::TopicManager::instance()->getNumPublishers("/clock") > 0;
  return reading;
}

std::string stepText(const ReplayTimeline& timeline) {
  char text[64];
  std::snprintf(text, sizeof text, "at step %.2f of %.0f", timeline.position(), timeline.steps());
  return text;
}

}  // namespace

ReplayOptions readReplayOptions(const XmlRpc::XmlRpcValue& parameters) {
  ParameterReader reader(parameters);
  ReplayOptions options;
  reader.read("robot_size", options.style.robot_size_cells);
  reader.read("trail_steps", options.style.trail_steps);
  reader.read("show_goals", options.style.goals);
  reader.read("show_labels", options.style.labels);
  reader.read("rate", options.rate_hz);
  reader.read("speed", options.speed);
  reader.read("loop", options.loop);
  reader.read("wait_for_viewer", options.wait_for_viewer);
  reader.read("grid_frame", options.grid_frame);
  requireAtLeast(0, "robot_size", options.style.robot_size_cells);
  requireAtLeast(0, "trail_steps", options.style.trail_steps);
  requireAtLeast(0.1, "rate", options.rate_hz);
  requireAtLeast(0, "speed", options.speed);
  reader.warnOfUnread();
  return options;
}

Replay::Replay(ros::NodeHandle node, ros::NodeHandle private_node, const ReplayOptions& options)
    : options_(options) {
  timeline_.setSpeed(options.speed);
  timeline_.setLoop(options.loop);
  const ros::SubscriberStatusCallback on_viewer = [this](const ros::SingleSubscriberPublisher&) {
    const std::lock_guard<std::mutex> lock(mutex_);
    shown_position_.reset();
  };
  publisher_ = private_node.advertise<visualization_msgs::MarkerArray>(
      "markers", 1, on_viewer, ros::SubscriberStatusCallback(), ros::VoidConstPtr(), true);
  layout_publisher_ =
      private_node.advertise<visualization_msgs::MarkerArray>("layout_markers", 1, true);
  const boost::function<void(const PlanLayoutConstPtr&)> on_layout =
      [this](const PlanLayoutConstPtr& layout) { takeLayout(*layout); };
  const boost::function<void(const MultiRobotPlanConstPtr&)> on_plan =
      [this](const MultiRobotPlanConstPtr& plan) { takePlan(*plan); };
  const boost::function<void(const nav_msgs::OccupancyGridConstPtr&)> on_grid =
      [this](const nav_msgs::OccupancyGridConstPtr& grid) { takeGrid(*grid); };
  const boost::function<bool(ReplayControl::Request&, ReplayControl::Response&)> on_control =
      [this](ReplayControl::Request& request, ReplayControl::Response& response) {
        return control(request, response);
      };
  plan_subscriber_ = node.subscribe<MultiRobotPlan>("plan", 1, on_plan);
  grid_subscriber_ = node.subscribe<nav_msgs::OccupancyGrid>("planning_grid", 1, on_grid);
  layout_subscriber_ = node.subscribe<PlanLayout>("layout", 1, on_layout);
  control_ = private_node.advertiseService("control", on_control);
  timer_ = node.createWallTimer(ros::WallDuration(1 / options.rate_hz),
                                [this](const ros::WallTimerEvent& /*event*/) { tick(); });
}

void Replay::takePlan(const MultiRobotPlan& plan) {
  const std::lock_guard<std::mutex> lock(mutex_);
  try {
    markers_ = PlanMarkers(plan, options_.style);
  } catch (const std::exception& error) {
    // The plan that is shown, if any, goes on.
    ROS_ERROR("a plan that cannot be shown: %s", error.what());
    return;
  }
  plan_grid_ = plan.grid;
  compare_at_ = ros::WallTime::now() + ros::WallDuration(kComparisonDelaySec);
  timeline_.load(markers_->steps(), plan.step_duration);
  shown_position_.reset();
  tellFrameLocked(plan);
  ROS_INFO("replaying %zu robots, %.0f steps of %.2f s, at %.1f times their pace",
           plan.paths.size(), markers_->steps(), plan.step_duration, timeline_.speed());
}

void Replay::tellFrameLocked(const MultiRobotPlan& plan) {
  const MapGeometry geometry(plan.grid, plan.header.frame_id);
  if (options_.grid_frame.empty() || options_.grid_frame == geometry.frame()) return;
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = ros::Time::now();
  transform.header.frame_id = geometry.frame();
  transform.child_frame_id = options_.grid_frame;
  transform.transform.translation.x = geometry.info().origin.position.x;
  transform.transform.translation.y = geometry.info().origin.position.y;
  transform.transform.translation.z = geometry.info().origin.position.z;
  transform.transform.rotation = quaternionOf(geometry.yaw());
  broadcaster_.sendTransform(transform);
}

void Replay::takeLayout(const PlanLayout& layout) {
  try {
    layout_publisher_.publish(layoutMarkers(layout));
  } catch (const std::exception& error) {
    ROS_ERROR("a layout that cannot be shown: %s", error.what());
  }
}

void Replay::takeGrid(const nav_msgs::OccupancyGrid& grid) {
  const std::lock_guard<std::mutex> lock(mutex_);
  shown_grid_ = grid.info;
  compare_at_ = ros::WallTime::now() + ros::WallDuration(kComparisonDelaySec);
}

void Replay::tick() {
  const std::lock_guard<std::mutex> lock(mutex_);
  const ros::Time now = ros::Time::now();
  // rviz forgets what it shows when time jumps back, as in a looped bag.
  if (now < last_tick_) shown_position_.reset();
  last_tick_ = now;
  moveLocked(now);
  compareGridsLocked();
  if (!markers_) return;
  const bool moves = shown_position_ != timeline_.position();
  const MarkerParts parts = duePartsLocked(moves);
  if (moves || parts.goals || parts.trails) publishLocked(parts);
}

MarkerParts Replay::duePartsLocked(bool moves) const {
  if (!shown_position_) return {};
  const ros::SteadyTime now = ros::SteadyTime::now();
  MarkerParts due;
  const double position = timeline_.position();
  if (!moves) {
    // The last message of a motion is latched for whoever comes later, so it has all. As long as
    // robots stand it holds, and a bag needs no more of it.
    due.goals = due.trails = goals_position_ != position || trails_position_ != position;
    return due;
  }
  due.goals = (now - goals_at_).toSec() >= kGoalsSec;
  due.trails =
      trails_position_ != position && (due.goals || (now - trails_at_).toSec() >= kTrailsSec);
  return due;
}

void Replay::moveLocked(ros::Time now) {
  const ReplayClock::Time time = clock_.read(readClocks(now));
  if (time.anew) timeline_.startAnew();
  if (!options_.wait_for_viewer || isWatchedLocked()) {
    timeline_.advance(time.sec);
  } else {
    timeline_.hold();
  }
}

bool Replay::isWatchedLocked() {
  if (publisher_.getNumSubscribers() == 0) {
    watched_since_.reset();
    return false;
  }
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (!watched_since_) watched_since_ = now;
  return (now - *watched_since_).toSec() >= kFirstLookSec;
}

void Replay::publishLocked(MarkerParts parts) {
  publisher_.publish(markers_->at(timeline_.position(), last_tick_, shown_labels_, parts));
  shown_labels_ = markers_->labels();
  shown_position_ = timeline_.position();
  if (parts.goals) {
    goals_at_ = ros::SteadyTime::now();
    goals_position_ = timeline_.position();
  }
  if (!parts.trails) return;
  trails_at_ = ros::SteadyTime::now();
  trails_position_ = timeline_.position();
}

void Replay::compareGridsLocked() {
  if (compare_at_.isZero() || ros::WallTime::now() < compare_at_) return;
  compare_at_ = ros::WallTime();
  if (!plan_grid_ || !shown_grid_ || sameCells(*plan_grid_, *shown_grid_)) return;
  ROS_WARN("the plan was made on %ux%u cells, the planning grid has %ux%u", plan_grid_->width,
           plan_grid_->height, shown_grid_->width, shown_grid_->height);
}

bool Replay::control(ReplayControl::Request& request, ReplayControl::Response& response) {
  const std::lock_guard<std::mutex> lock(mutex_);
  try {
    response.message = obey(request);
    response.ok = true;
    shown_position_.reset();
  } catch (const InputError& error) {
    response.message = error.what();
    response.ok = false;
  }
  return true;
}

std::string Replay::obey(const ReplayControl::Request& request) {
  if (!std::isfinite(request.value)) throw InputError("the value is not a finite number");
  switch (request.command) {
    case ReplayControl::Request::PLAY:
      timeline_.play();
      return "playing " + stepText(timeline_);
    case ReplayControl::Request::PAUSE:
      timeline_.pause();
      return "paused " + stepText(timeline_);
    case ReplayControl::Request::SPEED:
      if (request.value <= 0) throw InputError("SPEED needs a value > 0");
      timeline_.setSpeed(request.value);
      return "playing at " + numeral(request.value) + " times the plan's pace";
    case ReplayControl::Request::LOOP:
      timeline_.setLoop(request.value != 0);
      return timeline_.loop() ? "starting again at the end" : "stopping at the end";
    case ReplayControl::Request::STEP:
    case ReplayControl::Request::SEEK:
      break;
    default:
      throw InputError("command " + std::to_string(request.command) +
                       " is none of PLAY, PAUSE, STEP, SEEK, SPEED, LOOP");
  }
  if (!markers_) throw InputError("there is no plan yet");
  if (request.command == ReplayControl::Request::STEP) {
    timeline_.step(request.value == 0 ? 1 : request.value);
  } else {
    if (request.value < 0 || request.value > timeline_.steps()) {
      throw InputError("SEEK needs a step from 0 to " + std::to_string(timeline_.steps()));
    }
    timeline_.seek(request.value);
  }
  return stepText(timeline_);
}

}  // namespace split_mapf
