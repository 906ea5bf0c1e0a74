#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <split_mapf/FleetState.h>
#include <split_mapf/MultiRobotPlan.h>
#include <split_mapf/PlanLayout.h>
#include <split_mapf/PlanPathsActionResult.h>
#include <split_mapf/PlanPathsResult.h>
#include <split_mapf/RobotProgress.h>
#include <visualization_msgs/MarkerArray.h>

#include "ros/scene/plan_scene.h"

namespace split_mapf {

/// The topics of a display; an empty one is not subscribed.
struct FeedTopics {
  std::string plan;
  std::string layout;
  std::string roadmap;
  std::string fleet_state;
  std::string progress;
  std::string result;  ///< of the action PlanPaths
};

/// What has come in since it was asked last; what is null or empty has not.
struct FeedNews {
  std::shared_ptr<const PlanScene> scene;
  std::string plan_fault;  ///< why the latest plan cannot be shown
  PlanLayoutConstPtr layout;
  visualization_msgs::MarkerArrayConstPtr roadmap;
  FleetStateConstPtr fleet;
  std::map<std::string, RobotProgressConstPtr> progress;  ///< the latest of each robot
  std::optional<std::string> outcome;                     ///< of the latest goal, one sentence
};

/// Takes messages and works them up on the thread that the node handle's queue has, so that the
/// window never waits for a large plan. Thread-safe.
class PlanFeed {
 public:
  /// @param node  whose callback queue is not that of the window.
  explicit PlanFeed(const ros::NodeHandle& node) : node_(node) {}
  PlanFeed(const PlanFeed&) = delete;
  PlanFeed& operator=(const PlanFeed&) = delete;
  ~PlanFeed();

  /// Listens to these topics; who stays the same goes on. @throws ros::Exception for a name that is
  /// none, and listens to those that come before it.
  void subscribe(const FeedTopics& topics);
  void unsubscribe();
  FeedNews takeNews();

 private:
  enum Slot { kPlan, kLayout, kRoadmap, kFleetState, kProgress, kResult, kSlots };
  struct Listening {
    std::string topic;
    ros::Subscriber subscriber;
  };

  template <class Message, class Take>
  void listen(Slot slot, const std::string& topic, std::uint32_t queue, Take take);
  void take(const MultiRobotPlan& plan);
  void take(const PlanPathsResult& result);

  ros::NodeHandle node_;
  std::array<Listening, kSlots> listening_;
  std::mutex mutex_;
  FeedNews news_;
};

}  // namespace split_mapf
