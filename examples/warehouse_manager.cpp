// A small fleet manager: orders of a warehouse, each a shelf and then a station, given to robots
// through the action `move` of the node `fleet`. warehouse_manager.py does the same in Python, and
// says which topics and parameters there are.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <map>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <actionlib/client/action_client.h>
#include <ros/ros.h>
#include <split_mapf/MoveRobotsAction.h>
#include <split_mapf/PlanOutcome.h>
#include <split_mapf/RobotProgress.h>
#include <visualization_msgs/MarkerArray.h>

#include "warehouse.h"

namespace {

using example::Cell;
using example::kCell;
using example::kFrame;
using example::pointIn;
using example::Warehouse;
using split_mapf::MoveRobotsGoal;
using split_mapf::RobotProgress;
using Moves = actionlib::ActionClient<split_mapf::MoveRobotsAction>;

constexpr double kRestSec = 5;     // that a robot is left alone whose move failed
constexpr double kSilenceSec = 2;  // after which a robot is given no order
constexpr double kTickSec = 0.1;

/// To the shelf first, then to the station.
struct Order {
  std::deque<Cell> legs;
};

struct Robot {
  Cell at;
  ros::Time heard;
  bool is_well = false;
  std::optional<Order> order;
  Moves::GoalHandle goal;
  ros::Time rests_until;
};

class Manager {
 public:
  explicit Manager(ros::NodeHandle own)
      : warehouse_(own.param("columns", 8), own.param("rows", 16)),
        chance_(static_cast<std::uint32_t>(own.param("seed", 0))),
        most_orders_(own.param("orders", 0)),
        report_sec_(own.param("report", 5.0)),
        moves_("fleet/move") {
    map_ = node_.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
    plan_ = node_.advertise<split_mapf::MultiRobotPlan>("plan", 1, true);
    markers_ = own.advertise<visualization_msgs::MarkerArray>("markers", 1, true);
    map_.publish(warehouse_.asMap());
    const int robots = own.param("robots", 200);
    if (robots > 0) plan_.publish(warehouse_.startsOf(static_cast<std::size_t>(robots)));
    progress_ = node_.subscribe("progress", 1000, &Manager::hear, this);
  }

  void run() {
    ROS_INFO("%zu stations, %zu places to pick from; waiting for fleet/move",
             warehouse_.stations.size(), warehouse_.picks.size());
    // What it waits for comes in by spinOnce().
    while (ros::ok() && !moves_.waitForActionServerToStart(ros::Duration(kTickSec))) {
      ros::spinOnce();
    }
    begin_ = ros::Time::now();
    ros::Time next_report = begin_;
    ros::Rate rate(1 / kTickSec);
    while (ros::ok() && (most_orders_ == 0 || done_ < most_orders_)) {
      ros::spinOnce();
      takeEnds();
      takeOrders();
      giveOrders();
      if (ros::Time::now() >= next_report) {
        next_report = ros::Time::now() + ros::Duration(report_sec_);
        report();
      }
      rate.sleep();
    }
    report();
  }

 private:
  void hear(const RobotProgress& progress) {
    Robot& robot = robots_[progress.robot_id];
    robot.at.x = static_cast<int>(std::floor(progress.pose.pose.position.x / kCell));
    robot.at.y = static_cast<int>(std::floor(progress.pose.pose.position.y / kCell));
    robot.heard = ros::Time::now();
    robot.is_well = progress.status == RobotProgress::OK;
  }

  Cell anyOf(const std::vector<Cell>& cells) {
    return cells[std::uniform_int_distribution<std::size_t>(0, cells.size() - 1)(chance_)];
  }

  /// As many come in as there are robots, so that none is idle.
  void takeOrders() {
    const int open = given_ - done_;
    int limit = static_cast<int>(robots_.size());
    if (most_orders_ > 0) limit = std::min(limit, open + most_orders_ - given_);
    for (int i = open; i < limit; ++i) {
      const Cell pick = anyOf(warehouse_.picks);
      waiting_.push_back({{pick, anyOf(warehouse_.stations)}});
      ++given_;
    }
  }

  /// Each order to the nearest robot that is free.
  void giveOrders() {
    const ros::Time now = ros::Time::now();
    std::vector<std::pair<const std::string*, Robot*>> free;
    for (auto& [name, robot] : robots_) {
      const bool is_heard = (now - robot.heard).toSec() < kSilenceSec;
      if (!robot.order && robot.is_well && is_heard && now >= robot.rests_until) {
        free.emplace_back(&name, &robot);
      }
    }
    while (!waiting_.empty() && !free.empty()) {
      const Cell to = waiting_.front().legs.front();
      const auto far = [to](const auto& entry) {
        return std::abs(entry.second->at.x - to.x) + std::abs(entry.second->at.y - to.y);
      };
      const auto nearest = std::min_element(
          free.begin(), free.end(),
          [&far](const auto& one, const auto& other) { return far(one) < far(other); });
      nearest->second->order = std::move(waiting_.front());
      waiting_.pop_front();
      send(*nearest->first, *nearest->second);
      free.erase(nearest);
    }
  }

  void send(const std::string& name, Robot& robot) {
    MoveRobotsGoal goal;
    goal.robots.resize(1);
    goal.robots.front().robot_id = name;  // an empty start: where it is
    goal.robots.front().goal.header.frame_id = kFrame;
    goal.robots.front().goal.pose.position = pointIn(robot.order->legs.front());
    robot.goal = moves_.sendGoal(goal, [this, name](const Moves::GoalHandle& handle) {
      if (handle.getCommState() == actionlib::CommState::DONE) ended_.push_back(name);
    });
  }

  void takeEnds() {
    while (!ended_.empty()) {
      const std::string name = ended_.front();
      ended_.pop_front();
      Robot& robot = robots_[name];
      const auto result = robot.goal.getResult();
      if (result && result->outcome == split_mapf::PlanOutcome::SUCCEEDED) {
        robot.order->legs.pop_front();
        if (!robot.order->legs.empty()) {
          send(name, robot);
          continue;
        }
        ++done_;
        times_.push_back(ros::Time::now());
      } else {
        // Somebody else brings the order to its end.
        ROS_WARN("robot %s did not get to (%d, %d): %s", name.c_str(), robot.order->legs.front().x,
                 robot.order->legs.front().y, result ? result->message.c_str() : "no answer");
        ++failed_;
        waiting_.push_front(std::move(*robot.order));
        robot.rests_until = ros::Time::now() + ros::Duration(kRestSec);
      }
      robot.order.reset();
      robot.goal.reset();
    }
  }

  void report() {
    const ros::Time now = ros::Time::now();
    while (!times_.empty() && (now - times_.front()).toSec() > 60) times_.pop_front();
    const double passed = (now - begin_).toSec();
    const double span = std::max(1.0, std::min(60.0, passed));
    std::vector<geometry_msgs::Point> picks;
    std::size_t busy = 0;
    for (const auto& [name, robot] : robots_) {
      if (!robot.order) continue;
      ++busy;
      if (robot.order->legs.size() == 2) picks.push_back(pointIn(robot.order->legs.front()));
    }
    std::printf(
        "%5.0f s: %5d orders done, %5.1f a minute; %zu of %zu robots busy, %zu orders wait, "
        "%d moves failed\n",
        passed, done_, 60 * static_cast<double>(times_.size()) / span, busy, robots_.size(),
        waiting_.size(), failed_);
    std::fflush(stdout);
    std::vector<geometry_msgs::Point> stations;
    for (const Cell cell : warehouse_.stations) stations.push_back(pointIn(cell));
    visualization_msgs::MarkerArray markers;
    markers.markers = {marker("stations", 0.1F, 0.7F, 0.2F, stations),
                       marker("picks", 0.9F, 0.5F, 0.1F, picks)};
    markers_.publish(markers);
  }

  static visualization_msgs::Marker marker(const char* space, float red, float green, float blue,
                                           std::vector<geometry_msgs::Point> points) {
    visualization_msgs::Marker marker;
    marker.header.frame_id = kFrame;
    marker.ns = space;
    marker.type = visualization_msgs::Marker::CUBE_LIST;
    marker.points = std::move(points);
    marker.pose.orientation.w = 1;
    marker.scale.x = marker.scale.y = 0.9 * kCell;
    marker.scale.z = 0.02;
    marker.color.r = red;
    marker.color.g = green;
    marker.color.b = blue;
    marker.color.a = 0.8F;
    return marker;
  }

  ros::NodeHandle node_;
  Warehouse warehouse_;
  std::mt19937 chance_;
  int most_orders_;  // 0: no end
  double report_sec_;
  Moves moves_;
  ros::Publisher map_;
  ros::Publisher plan_;
  ros::Publisher markers_;
  ros::Subscriber progress_;
  std::map<std::string, Robot> robots_;
  std::deque<Order> waiting_;
  std::deque<std::string> ended_;  // robots whose moves have ended
  std::deque<ros::Time> times_;    // of the orders done in the last minute
  ros::Time begin_;
  int given_ = 0;
  int done_ = 0;
  int failed_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "warehouse_manager");
  try {
    Manager(ros::NodeHandle("~")).run();
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "warehouse_manager: %s\n", error.what());
    return 1;
  }
  return 0;
}
