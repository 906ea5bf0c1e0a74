#include "rviz/plan_feed.h"

#include <exception>

#include "rviz/outcome_text.h"

namespace split_mapf {
namespace {

// Robots report one after another; of each the latest counts.
constexpr std::uint32_t kReports = 10000;

template <class Message, class Take>
ros::Subscriber listen(ros::NodeHandle& node, const std::string& topic, std::uint32_t queue,
                       Take take) {
  if (topic.empty()) return {};
  const boost::function<void(const boost::shared_ptr<const Message>&)> callback = take;
  return node.subscribe<Message>(topic, queue, callback);
}

}  // namespace

bool operator==(const FeedTopics& a, const FeedTopics& b) {
  return a.plan == b.plan && a.layout == b.layout && a.roadmap == b.roadmap &&
         a.fleet_state == b.fleet_state && a.progress == b.progress && a.result == b.result;
}

PlanFeed::~PlanFeed() { unsubscribe(); }

void PlanFeed::subscribe(const FeedTopics& topics) {
  unsubscribe();
  const auto keep = [this](auto member) {
    return [this, member](const auto& message) {
      const std::lock_guard<std::mutex> lock(mutex_);
      news_.*member = message;
    };
  };
  subscribers_.push_back(
      listen<MultiRobotPlan>(node_, topics.plan, 1, [this](const auto& plan) { take(*plan); }));
  subscribers_.push_back(listen<PlanLayout>(node_, topics.layout, 1, keep(&FeedNews::layout)));
  subscribers_.push_back(
      listen<visualization_msgs::MarkerArray>(node_, topics.roadmap, 1, keep(&FeedNews::roadmap)));
  subscribers_.push_back(listen<FleetState>(node_, topics.fleet_state, 1, keep(&FeedNews::fleet)));
  subscribers_.push_back(listen<RobotProgress>(node_, topics.progress, kReports,
                                               [this](const RobotProgressConstPtr& progress) {
                                                 const std::lock_guard<std::mutex> lock(mutex_);
                                                 news_.progress[progress->robot_id] = progress;
                                               }));
  subscribers_.push_back(listen<PlanPathsActionResult>(
      node_, topics.result, 1, [this](const auto& result) { take(result->result); }));
}

void PlanFeed::unsubscribe() {
  // Waits for a callback that runs; it may want the mutex.
  for (ros::Subscriber& subscriber : subscribers_) subscriber.shutdown();
  subscribers_.clear();
}

FeedNews PlanFeed::takeNews() {
  const std::lock_guard<std::mutex> lock(mutex_);
  FeedNews news;
  std::swap(news, news_);
  return news;
}

void PlanFeed::take(const MultiRobotPlan& plan) {
  std::shared_ptr<const PlanScene> scene;
  std::string fault;
  try {
    scene = std::make_shared<const PlanScene>(plan);
  } catch (const std::exception& error) {
    fault = error.what();
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  news_.scene = scene;
  news_.plan_fault = fault;
}

void PlanFeed::take(const PlanPathsResult& result) {
  const std::string outcome = outcomeText(result);
  const std::lock_guard<std::mutex> lock(mutex_);
  news_.outcome = outcome;
}

}  // namespace split_mapf
