#pragma once

#include <memory>
#include <mutex>
#include <string>

#include <nav_msgs/OccupancyGrid.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>

namespace split_mapf {

/// Reads a map file (MovingAI `.map`, or map_server `.yaml`) as a map in frame `map`. A `.map` has
/// cells of 1 m and its lower left corner at the origin.
/// @throws InputError as readMap().
nav_msgs::OccupancyGrid readMapMessage(const std::string& path);

/// The latest map on the topic `map`; an empty one is none. Thread-safe.
class MapSource {
 public:
  /// @param map_file  published on `map`, latched, unless empty. @throws InputError.
  MapSource(ros::NodeHandle node, const std::string& map_file);

  /// The given map, or the latest one when it is empty (0x0). The pointer is never null.
  /// @throws GoalError (INVALID_MAP) when it is empty and no map has arrived.
  std::shared_ptr<const nav_msgs::OccupancyGrid> choose(
      const std::shared_ptr<const nav_msgs::OccupancyGrid>& given) const;

 private:
  void take(std::shared_ptr<const nav_msgs::OccupancyGrid> map);

  std::string topic_;
  mutable std::mutex mutex_;
  std::shared_ptr<const nav_msgs::OccupancyGrid> latest_;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
};

}  // namespace split_mapf
