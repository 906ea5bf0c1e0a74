#include "ros/fleet/vda5050_bridge.h"

#include <cmath>
#include <set>

#include <ros/console.h>
#include <split_mapf/RobotProgress.h>

#include "ros/convert/parameter_reader.h"
#include "ros/convert/text_limits.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/ros/orientation.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kQueue = 20000;  // messages: two seconds of a thousand robots
constexpr std::int64_t kMostPort = 65535;

/// Monotonic, and not simulated: a broker keeps no simulated time.
double now() { return ros::SteadyTime::now().toSec(); }
double unixTime() { return ros::WallTime::now().toSec(); }

/// A level of an MQTT topic.
std::string readLevel(ParameterReader& reader, const char* name, std::string value) {
  reader.read(name, value);
  if (!value.empty() && value.find_first_of("/+#") == std::string::npos) return value;
  throw OptionError(std::string("parameter ~") + name + " is " + quote(value) +
                    "; a name without /, + and # is expected, as it stands in MQTT topics");
}

/// "r1" or "r1=AGV-1": a robot, and its serial number where that is another one.
std::map<std::string, std::string> robotsOf(const std::vector<std::string>& entries) {
  std::map<std::string, std::string> robots;
  std::set<std::string> ids;
  for (const std::string& entry : entries) {
    const std::size_t equal = entry.find('=');
    const std::string id = entry.substr(0, equal);
    const std::string serial = equal == std::string::npos ? id : entry.substr(equal + 1);
    if (id.empty() || serial.empty() || serial.find_first_of("/+#") != std::string::npos) {
      throw OptionError("parameter ~robots has the entry " + quote(entry) +
                        "; ROBOT or ROBOT=SERIALNUMBER, without /, + and #, is expected");
    }
    const std::string fault = faultOfRobotId(id);
    if (!fault.empty()) throw OptionError("parameter ~robots: the id " + quote(id) + " " + fault);
    if (!ids.insert(id).second) {
      throw OptionError("parameter ~robots has the robot " + quote(id) + " twice");
    }
    if (!robots.emplace(serial, id).second) {
      throw OptionError("parameter ~robots has the serial number " + quote(serial) + " twice");
    }
  }
  return robots;
}

PlacedRoute placedRoute(const RobotRoute& message) {
  PlacedRoute route{message.plan_id, {}};
  for (const RouteVisit& visit : message.visits) {
    const geometry_msgs::Pose& pose = visit.pose;
    route.visits.push_back({visit.sequence, visit.cell, pose.position.x, pose.position.y,
                            yawOf(pose.orientation), visit.released != 0});
  }
  return route;
}

}  // namespace

Vda5050BridgeOptions readVda5050BridgeOptions(const XmlRpc::XmlRpcValue& parameters) {
  ParameterReader reader(parameters);
  Vda5050BridgeOptions options;
  reader.read("host", options.host);
  options.port =
      static_cast<std::uint16_t>(reader.readInteger("port", options.port, {1, kMostPort}));
  reader.read("user", options.user);
  reader.read("password", options.password);
  options.interface_name = readLevel(reader, "interface_name", options.interface_name);
  options.version = readLevel(reader, "version", options.version);
  Vda5050Options& vehicle = options.vehicle;
  vehicle.manufacturer = readLevel(reader, "manufacturer", "split_mapf");
  reader.read("protocol_version", vehicle.version);
  reader.read("frame", options.frame);
  vehicle.map_id = "";
  reader.read("map_id", vehicle.map_id);
  if (vehicle.map_id.empty()) vehicle.map_id = options.frame;
  vehicle.allowed_deviation_m =
      reader.readPositive("allowed_deviation", vehicle.allowed_deviation_m);
  vehicle.resend_sec = reader.readPositive("resend_time", vehicle.resend_sec);
  vehicle.state_timeout_sec = reader.readPositive("state_timeout", vehicle.state_timeout_sec);
  options.rate_hz = reader.readPositive("rate", options.rate_hz);
  std::vector<std::string> robots;
  reader.read("robots", robots);
  options.robots = robotsOf(robots);
  reader.warnOfUnread();
  return options;
}

Vda5050Bridge::Vda5050Bridge(ros::NodeHandle node, const ros::NodeHandle& private_node,
                             const Vda5050BridgeOptions& options, Send send)
    : options_(options),
      send_(std::move(send)),
      frame_(options.frame),
      why_("it was not tried yet"),
      updater_(node, private_node) {
  for (const auto& [serial, id] : options_.robots) add(id, serial);
  progress_ = node.advertise<RobotProgress>("progress", kQueue);
  route_ = node.subscribe("routes", kQueue, &Vda5050Bridge::takeRoute, this,
                          ros::TransportHints().tcpNoDelay());
  updater_.setHardwareID("none");
  updater_.add("vda5050",
               [this](diagnostic_updater::DiagnosticStatusWrapper& status) { diagnose(status); });
  timer_ = node.createWallTimer(ros::WallDuration(1 / options_.rate_hz),
                                [this](const ros::WallTimerEvent&) { tick(); });
  diagnostics_timer_ = node.createWallTimer(
      ros::WallDuration(1.0), [this](const ros::WallTimerEvent&) { updater_.force_update(); });
}

std::vector<std::string> Vda5050Bridge::topics() const {
  const std::string all = options_.interface_name + "/" + options_.version + "/" +
                          options_.vehicle.manufacturer + "/+/";
  return {all + "state", all + "connection"};
}

Vda5050Bridge::Robot& Vda5050Bridge::add(const std::string& id, const std::string& serial) {
  Vda5050Options vehicle = options_.vehicle;
  vehicle.serial_number = serial;
  by_serial_[serial] = id;
  const std::string topic = options_.interface_name + "/" + options_.version + "/" +
                            vehicle.manufacturer + "/" + serial + "/";
  return robots_.emplace(id, Robot{Vda5050Vehicle(vehicle), topic, "", 0}).first->second;
}

/// Null: it is none of ours.
Vda5050Bridge::Robot* Vda5050Bridge::robotOf(const std::string& serial) {
  const auto found = by_serial_.find(serial);
  if (found != by_serial_.end()) return &robots_.at(found->second);
  if (!options_.robots.empty() || !faultOfRobotId(serial).empty()) return nullptr;
  Robot& robot = add(serial, serial);
  ROS_INFO("robot %s reports for the first time", quote(serial).c_str());
  const auto route = routes_.find(serial);
  if (route != routes_.end()) robot.vehicle.take(placedRoute(route->second));
  routes_.erase(serial);
  return &robot;
}

void Vda5050Bridge::connected() {
  const Lock lock(mutex_);
  connected_ = true;
  why_.clear();
  for (auto& [id, robot] : robots_) robot.vehicle.sendAgain();
  ROS_INFO("connected to the broker %s:%u", options_.host.c_str(), options_.port);
}

void Vda5050Bridge::lost(const std::string& why) {
  const Lock lock(mutex_);
  if (connected_) {
    ++losses_;
    ROS_WARN("the broker %s:%u is away: %s; robots are silent until it is back",
             options_.host.c_str(), options_.port, why.c_str());
  } else {
    ROS_WARN_THROTTLE(30, "the broker %s:%u cannot be reached: %s; trying again",
                      options_.host.c_str(), options_.port, why.c_str());
  }
  connected_ = false;
  why_ = why;
}

void Vda5050Bridge::receive(const std::string& topic, const std::string& text) {
  const std::size_t name = topic.rfind('/');
  const std::size_t serial =
      name == std::string::npos || name == 0 ? std::string::npos : topic.rfind('/', name - 1);
  if (serial == std::string::npos) return;
  const std::string kind = topic.substr(name + 1);
  const Lock lock(mutex_);
  Robot* const robot = robotOf(topic.substr(serial + 1, name - serial - 1));
  if (robot == nullptr) return;
  try {
    if (kind == "connection") robot->vehicle.take(parseVda5050Connection(text));
    if (kind == "state") robot->vehicle.take(parseVda5050State(text), now());
    serve(by_serial_.at(topic.substr(serial + 1, name - serial - 1)), *robot);
  } catch (const InputError& error) {
    robot->refused = kind + ": " + error.what();
    ++robot->refusals;
    ROS_WARN_THROTTLE(1, "%s is left out: %s", quote(topic).c_str(), error.what());
  }
}

void Vda5050Bridge::takeRoute(const RobotRoute& route) {
  const Lock lock(mutex_);
  if (!route.header.frame_id.empty()) frame_ = route.header.frame_id;
  const auto robot = robots_.find(route.robot_id);
  if (robot == robots_.end()) {
    if (options_.robots.empty()) routes_[route.robot_id] = route;
    return;
  }
  robot->second.vehicle.take(placedRoute(route));
  serve(robot->first, robot->second);
}

/// Sends what is due, and tells the fleet.
void Vda5050Bridge::serve(const std::string& id, Robot& robot) {
  if (!connected_) return;
  const double time = now();
  const auto message = robot.vehicle.due(time, unixTime());
  if (message && !send_(robot.topic + message->topic, message->text)) robot.vehicle.sendAgain();
  tell(id, robot, time);
}

void Vda5050Bridge::tell(const std::string& id, const Robot& robot, double time) {
  const auto progress = robot.vehicle.progress(time);
  if (!progress) return;
  RobotProgress message;
  message.robot_id = id;
  message.plan_id = progress->plan_id;
  message.sequence = progress->sequence;
  message.fraction = static_cast<float>(progress->fraction);
  message.status = static_cast<std::uint8_t>(progress->status);
  if (progress->position) {
    message.pose.header.frame_id = frame_;
    message.pose.header.stamp = ros::Time::now();
    message.pose.pose.position.x = progress->position->x_m;
    message.pose.pose.position.y = progress->position->y_m;
    message.pose.pose.orientation = quaternionOf(progress->position->theta_rad);
  }
  progress_.publish(message);
}

void Vda5050Bridge::tick() {
  const Lock lock(mutex_);
  for (auto& [id, robot] : robots_) serve(id, robot);
}

void Vda5050Bridge::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const Lock lock(mutex_);
  std::size_t troubles = 0;
  std::uint64_t refusals = 0;
  std::string refused;
  const double time = now();
  for (const auto& [id, robot] : robots_) {
    refusals += robot.refusals;
    if (!robot.refused.empty()) refused = "robot " + quote(id) + ", " + robot.refused;
    const std::string trouble = robot.vehicle.trouble(time);
    if (trouble.empty()) continue;
    ++troubles;
    status.add("robot " + id, trouble);
  }
  if (!connected_) {
    status.summary(DiagnosticStatus::ERROR, "the broker is away, trying again: " + why_);
  } else if (troubles > 0) {
    status.summary(DiagnosticStatus::WARN, counted(troubles, "robot") + " in trouble");
  } else {
    status.summary(DiagnosticStatus::OK, "connected");
  }
  status.add("broker", options_.host + ":" + std::to_string(options_.port));
  status.add("times that it was lost", losses_);
  status.add("robots", robots_.size());
  status.add("messages that cannot be read", refusals);
  status.add("the last of them", refused);
}

}  // namespace split_mapf
