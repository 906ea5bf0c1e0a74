#include "ros/server/plan_publisher.h"

#include <utility>
#include <vector>

#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Path.h>
#include <visualization_msgs/MarkerArray.h>

#include "ros/convert/disc_goal.h"
#include "split_mapf/ros/plan_messages.h"

namespace split_mapf {

PlanPublisher::PlanPublisher(const ros::NodeHandle& node, ros::NodeHandle private_node,
                             bool publish_paths)
    : node_(node),
      publish_paths_(publish_paths),
      plan_(private_node.advertise<MultiRobotPlan>("plan", 1, true)),
      layout_(private_node.advertise<PlanLayout>("layout", 1, true)),
      grid_(private_node.advertise<nav_msgs::OccupancyGrid>("planning_grid", 1, true)),
      roadmap_(private_node.advertise<visualization_msgs::MarkerArray>("roadmap", 1, true)) {}

void PlanPublisher::publish(const MultiRobotPlan& plan, const PlanLayout& layout,
                            const PlanningGrid& grid) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (last_grid_.lock() != grid.grid) {
    grid_.publish(toMessage(grid, plan.header.stamp));
    roadmap_.publish(roadmapMarkers(grid, plan.header.stamp));
    last_grid_ = grid.grid;
  }
  layout_.publish(layout);
  plan_.publish(plan);
  if (publish_paths_) publishPaths(plan);
}

void PlanPublisher::publishPaths(const MultiRobotPlan& plan) {
  std::map<std::string, ros::Publisher> paths;
  const RobotWays ways(plan, MapGeometry(plan.grid, plan.header.frame_id));
  for (std::size_t robot = 0; robot < plan.paths.size(); ++robot) {
    const std::string name = rosNameOf(plan.paths[robot].robot_id);
    const auto known = paths_.find(name);
    ros::Publisher& publisher = paths[name];
    publisher = known != paths_.end() ? known->second
                                      : node_.advertise<nav_msgs::Path>(name + "/path", 1, true);
    publisher.publish(posesOf(ways, robot));
  }
  // Publishers of robots that have no path any more end here, and their latched paths with them.
  paths_ = std::move(paths);
}

}  // namespace split_mapf
