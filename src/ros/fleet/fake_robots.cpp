#include "ros/fleet/fake_robots.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <ros/console.h>

#include "ros/convert/parameter_reader.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/ros/markers.h"
#include "split_mapf/ros/orientation.h"
#include "split_mapf/ros/outcome.h"
#include "split_mapf/ros/plan_messages.h"
#include "split_mapf/ros/planning_grid.h"

namespace split_mapf {
namespace {

constexpr double kSubstepSec = 0.02;
// After a longer pause of the clock robots go on from where they are.
constexpr double kLongestTickSec = 1;
constexpr std::uint32_t kQueue = 20000;
constexpr std::int64_t kMostSteps = 1000000;

std::map<std::string, double> failuresOf(const std::vector<std::string>& entries) {
  std::map<std::string, double> failures;
  for (const std::string& entry : entries) {
    const std::size_t colon = entry.rfind(':');
    char* end = nullptr;
    const double seconds =
        colon == std::string::npos ? -1 : std::strtod(entry.c_str() + colon + 1, &end);
    if (colon == std::string::npos || *end != '\0' || !(seconds >= 0)) {
      throw OptionError("parameter ~failures has the entry " + quote(entry) +
                        "; ROBOT:SECONDS is expected");
    }
    failures[entry.substr(0, colon)] = seconds;
  }
  return failures;
}

void readDelays(ParameterReader& reader, DelayModel& delays) {
  reader.read("delay_probability", delays.probability);
  delays.min_delay =
      static_cast<std::uint32_t>(reader.readInteger("min_delay", 1, {1, kMostSteps}));
  delays.max_delay = static_cast<std::uint32_t>(
      reader.readInteger("max_delay", delays.min_delay, {1, kMostSteps}));
  delays.seed = static_cast<std::uint64_t>(reader.readInteger("seed", 0, {0, 0x7fffffff}));
  std::string process = toString(delays.process);
  std::string distribution = toString(delays.distribution);
  reader.read("delay_process", process);
  reader.read("delay_distribution", distribution);
  delays.process = parseDelayProcess(process);
  delays.distribution = parseDelayDistribution(distribution);
  requireValid(delays);
}

geometry_msgs::Point pointAt(PlanePoint at, double height) {
  geometry_msgs::Point point;
  point.x = at.x;
  point.y = at.y;
  point.z = height;
  return point;
}

std_msgs::ColorRGBA grey() {
  std_msgs::ColorRGBA colour;
  colour.r = colour.g = colour.b = 0.1F;
  colour.a = 1;
  return colour;
}

}  // namespace

FakeRobotsOptions readFakeRobotsOptions(const XmlRpc::XmlRpcValue& parameters) {
  ParameterReader reader(parameters);
  FakeRobotsOptions options;
  options.motion.speed = reader.readPositive("speed", options.motion.speed);
  options.motion.acceleration = reader.readPositive("acceleration", 0, true);
  options.motion.turn_rate = reader.readPositive("turn_rate", 0, true);
  options.delay_step_sec = reader.readPositive("delay_step", options.delay_step_sec);
  options.rate_hz = reader.readPositive("rate", options.rate_hz);
  options.diameter_m = reader.readPositive("diameter", options.diameter_m, true);
  reader.read("publish_tf", options.publish_tf);
  readDelays(reader, options.delays);
  std::vector<std::string> failures;
  reader.read("failures", failures);
  options.failures = failuresOf(failures);
  reader.warnOfUnread();
  return options;
}

FakeRobots::FakeRobots(ros::NodeHandle node, ros::NodeHandle private_node,
                       const FakeRobotsOptions& options)
    : options_(options) {
  progress_ = node.advertise<RobotProgress>("progress", kQueue);
  markers_ = private_node.advertise<visualization_msgs::MarkerArray>("markers", 1, true);
  plan_ = node.subscribe("plan", 1, &FakeRobots::takePlan, this);
  routes_ = node.subscribe("routes", kQueue, &FakeRobots::takeRoute, this,
                           ros::TransportHints().tcpNoDelay());
  timer_ = node.createWallTimer(ros::WallDuration(1 / options_.rate_hz),
                                [this](const ros::WallTimerEvent&) { tick(); });
}

/// Robots that there are already stay where they are.
void FakeRobots::takePlan(const MultiRobotPlan& plan) {
  const std::lock_guard<std::mutex> lock(mutex_);
  try {
    const MapGeometry geometry(plan.grid, plan.header.frame_id);
    frame_ = geometry.frame();
    cell_m_ = plan.grid.resolution;
    if (isOnRoadmap(plan)) disc_m_ = 2 * plan.robot_radius;
    for (const RobotPath& path : plan.paths) {
      if (path.cells.empty() || index_.count(path.robot_id) > 0) continue;
      const geometry_msgs::Point at = isOnRoadmap(plan)
                                          ? path.start.position
                                          : geometry.centreOf(geometry.cellOf(path.cells.front()));
      Body body;
      body.id = path.robot_id;
      body.frame = rosNameOf(path.robot_id) + "/base_link";
      body.robot.emplace(PlanePoint{at.x, at.y}, geometry.yaw(), options_.motion);
      index_[body.id] = bodies_.size();
      bodies_.push_back(std::move(body));
    }
    delays_ = std::make_unique<Delays>(options_.delays, static_cast<std::uint32_t>(bodies_.size()));
  } catch (const GoalError& error) {
    ROS_ERROR("a plan is left out: %s", error.what());
  }
}

void FakeRobots::takeRoute(const RobotRoute& route) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = index_.find(route.robot_id);
  if (found == index_.end() || route.visits.empty()) return;
  Body& body = bodies_[found->second];
  std::vector<RouteLeg> legs;
  for (const RouteVisit& visit : route.visits) {
    const geometry_msgs::Point& at = visit.pose.position;
    legs.push_back({visit.sequence, {at.x, at.y}, visit.released != 0});
  }
  const bool fresh = route.plan_id != body.plan_id;
  if (!body.robot->take(legs, fresh)) return;
  body.plan_id = route.plan_id;
  if (body.began.isZero()) body.began = ros::Time::now();
}

void FakeRobots::tick() {
  const std::lock_guard<std::mutex> lock(mutex_);
  const ros::Time now = ros::Time::now();
  const double passed = last_.isZero() || now < last_ ? 0 : (now - last_).toSec();
  last_ = now;
  double left = std::min(passed, kLongestTickSec);
  failWhenDue(now);
  while (left > 1e-9) {
    const double step = std::min(left, kSubstepSec);
    drive(step);
    left -= step;
  }
  publishProgress(now);
  if (options_.publish_tf) publishTransforms(now);
  if (markers_.getNumSubscribers() > 0) publishMarkers(now);
}

void FakeRobots::failWhenDue(ros::Time now) {
  for (const auto& [id, seconds] : options_.failures) {
    const auto found = index_.find(id);
    if (found == index_.end()) continue;
    Body& body = bodies_[found->second];
    const bool due = !body.began.isZero() && (now - body.began).toSec() >= seconds;
    if (!due || body.status == RobotProgress::FAULT) continue;
    ROS_WARN("robot %s fails, as asked", id.c_str());
    body.status = RobotProgress::FAULT;
    body.robot->giveUp();
  }
}

void FakeRobots::drive(double seconds) {
  until_delays_ -= seconds;
  if (delays_ && until_delays_ <= 0) {
    delays_->nextStep();
    until_delays_ += options_.delay_step_sec;
  }
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    const bool failed = bodies_[i].status == RobotProgress::FAULT;
    bodies_[i].robot->advance(seconds, failed || delays_->isDelayed(i));
  }
}

void FakeRobots::publishProgress(ros::Time now) {
  for (const Body& body : bodies_) {
    RobotProgress message;
    message.robot_id = body.id;
    message.plan_id = body.plan_id;
    message.sequence = body.robot->sequence();
    message.fraction = static_cast<float>(body.robot->fraction());
    message.status = body.status;
    message.pose.header.frame_id = frame_;
    message.pose.header.stamp = now;
    message.pose.pose.position = pointAt(body.robot->position(), 0);
    message.pose.pose.orientation = quaternionOf(body.robot->heading());
    progress_.publish(message);
  }
}

void FakeRobots::publishTransforms(ros::Time now) {
  std::vector<geometry_msgs::TransformStamped> transforms;
  for (const Body& body : bodies_) {
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = frame_;
    transform.header.stamp = now;
    transform.child_frame_id = body.frame;
    const PlanePoint at = body.robot->position();
    transform.transform.translation.x = at.x;
    transform.transform.translation.y = at.y;
    transform.transform.rotation = quaternionOf(body.robot->heading());
    transforms.push_back(transform);
  }
  if (!transforms.empty()) transforms_.sendTransform(transforms);
}

visualization_msgs::Marker FakeRobots::markerOf(const char* space, int type, ros::Time now) const {
  visualization_msgs::Marker marker;
  marker.header.frame_id = frame_;
  marker.header.stamp = now;
  marker.ns = space;
  marker.type = type;
  marker.pose.orientation.w = 1;
  marker.color.a = 0.99F;
  return marker;
}

/// Discs in their colours, those that failed in black, and the ways ahead: what is released opaque.
void FakeRobots::publishMarkers(ros::Time now) {
  using visualization_msgs::Marker;
  const double known = disc_m_ > 0 ? disc_m_ : 0.8 * cell_m_;
  const double size = options_.diameter_m > 0 ? options_.diameter_m : known;
  Marker discs = markerOf("robots", Marker::SPHERE_LIST, now);
  discs.scale.x = discs.scale.y = size;
  discs.scale.z = size / 2;
  Marker ways = markerOf("routes", Marker::LINE_LIST, now);
  ways.scale.x = 0.2 * size;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    std_msgs::ColorRGBA colour = body.status == RobotProgress::OK ? colourOf(i) : grey();
    discs.points.push_back(pointAt(body.robot->position(), 0.3 * size));
    discs.colors.push_back(colour);
    PlanePoint from = body.robot->position();
    for (const RouteLeg& leg : body.robot->ahead()) {
      colour.a = leg.released ? 0.95F : 0.3F;
      ways.points.push_back(pointAt(from, 0.1 * size));
      ways.points.push_back(pointAt(leg.point, 0.1 * size));
      ways.colors.insert(ways.colors.end(), 2, colour);
      from = leg.point;
    }
  }
  if (discs.points.empty()) discs.action = Marker::DELETE;
  if (ways.points.empty()) ways.action = Marker::DELETE;
  visualization_msgs::MarkerArray array;
  array.markers = {ways, discs};
  markers_.publish(array);
}

}  // namespace split_mapf
