#include "ros/convert/map_source.h"

#include <utility>

#include <ros/console.h>

#include "split_mapf/io/map_file.h"
#include "split_mapf/ros/orientation.h"
#include "split_mapf/ros/outcome.h"

namespace split_mapf {

nav_msgs::OccupancyGrid readMapMessage(const std::string& path) {
  const OccupancyMap map = readOccupancyMap(path);
  nav_msgs::OccupancyGrid message;
  message.header.frame_id = "map";
  message.header.stamp = ros::Time::now();
  message.info.map_load_time = message.header.stamp;
  message.info.width = map.grid->width();
  message.info.height = map.grid->height();
  message.info.resolution = static_cast<float>(map.resolution_m);
  message.info.origin.position.x = map.origin.x_m;
  message.info.origin.position.y = map.origin.y_m;
  message.info.origin.orientation = quaternionOf(map.origin.yaw_rad);
  for (std::size_t row = message.info.height; row-- > 0;) {
    const auto begin =
        map.occupancy.begin() + static_cast<std::ptrdiff_t>(row * message.info.width);
    message.data.insert(message.data.end(), begin,
                        begin + static_cast<std::ptrdiff_t>(message.info.width));
  }
  return message;
}

MapSource::MapSource(ros::NodeHandle node, const std::string& map_file)
    : topic_(node.resolveName("map")) {
  if (!map_file.empty()) {
    const auto map = std::make_shared<const nav_msgs::OccupancyGrid>(readMapMessage(map_file));
    take(map);
    publisher_ = node.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
    publisher_.publish(*map);
  }
  const boost::function<void(const nav_msgs::OccupancyGridConstPtr&)> callback =
      [this](const nav_msgs::OccupancyGridConstPtr& map) {
        // Shares the message and keeps boost's pointer alive beside it.
        take(std::shared_ptr<const nav_msgs::OccupancyGrid>(map.get(), [map](const void*) {}));
      };
  subscriber_ = node.subscribe<nav_msgs::OccupancyGrid>("map", 1, callback);
}

std::shared_ptr<const nav_msgs::OccupancyGrid> MapSource::choose(
    const std::shared_ptr<const nav_msgs::OccupancyGrid>& given) const {
  const bool is_empty = given->info.width == 0 && given->info.height == 0 && given->data.empty();
  if (!is_empty) return given;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!latest_) {
    throw GoalError(Outcome::kInvalidMap, "map: an empty one was sent, which asks for the map on " +
                                              topic_ + ", but none has arrived there");
  }
  return latest_;
}

void MapSource::take(std::shared_ptr<const nav_msgs::OccupancyGrid> map) {
  if (map->info.width == 0 || map->info.height == 0) {
    ROS_WARN("an empty map of %ux%u cells on %s is left out", map->info.width, map->info.height,
             topic_.c_str());
    return;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  latest_ = std::move(map);
}

}  // namespace split_mapf
