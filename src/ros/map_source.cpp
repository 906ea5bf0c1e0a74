#include "split_mapf/ros/map_source.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "split_mapf/io/map_file.h"
#include "split_mapf/io/map_server.h"
#include "split_mapf/ros/orientation.h"
#include "split_mapf/ros/outcome.h"

namespace split_mapf {
namespace {

bool isYaml(std::string path) {
  std::transform(path.begin(), path.end(), path.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto ends_with = [&path](const std::string& end) {
    return path.size() >= end.size() &&
           path.compare(path.size() - end.size(), end.size(), end) == 0;
  };
  return ends_with(".yaml") || ends_with(".yml");
}

OccupancyMap readOccupancy(const std::string& path) {
  if (isYaml(path)) return readMapServerMap(path);
  OccupancyMap map;
  map.grid = readMap(path);
  map.resolution_m = 1;
  map.occupancy.assign(std::size_t{map.grid->width()} * map.grid->height(), 100);
  for (Vertex v = 0; v < map.grid->size(); ++v) {
    const Cell cell = map.grid->cellOf(v);
    map.occupancy[static_cast<std::size_t>(cell.y) * map.grid->width() +
                  static_cast<std::size_t>(cell.x)] = 0;
  }
  return map;
}

}  // namespace

nav_msgs::OccupancyGrid readMapMessage(const std::string& path) {
  const OccupancyMap map = readOccupancy(path);
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
  const std::lock_guard<std::mutex> lock(mutex_);
  latest_ = std::move(map);
}

}  // namespace split_mapf
