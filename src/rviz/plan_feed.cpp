#include "rviz/plan_feed.h"

#include <exception>

#include "rviz/outcome_text.h"

namespace split_mapf {
namespace {

// Robots report one after another; of each the latest counts.
constexpr std::uint32_t kReports = 10000;

}  // namespace

PlanFeed::~PlanFeed() { unsubscribe(); }

template <class Message, class Take>
void PlanFeed::listen(Slot slot, const std::string& topic, std::uint32_t queue, Take take) {
  Listening& listening = listening_[slot];
  if (listening.topic == topic) return;
  listening.subscriber.shutdown();
  listening.topic.clear();
  if (topic.empty()) return;
  const boost::function<void(const boost::shared_ptr<const Message>&)> callback = take;
  listening.subscriber = node_.subscribe<Message>(topic, queue, callback);
  listening.topic = topic;
}

void PlanFeed::subscribe(const FeedTopics& topics) {
  const auto keep = [this](auto member) {
    return [this, member](const auto& message) {
      const std::lock_guard<std::mutex> lock(mutex_);
      news_.*member = message;
    };
  };
  listen<MultiRobotPlan>(kPlan, topics.plan, 1, [this](const auto& plan) { take(*plan); });
  listen<PlanLayout>(kLayout, topics.layout, 1, keep(&FeedNews::layout));
  listen<visualization_msgs::MarkerArray>(kRoadmap, topics.roadmap, 1, keep(&FeedNews::roadmap));
  listen<FleetState>(kFleetState, topics.fleet_state, 1, keep(&FeedNews::fleet));
  listen<RobotProgress>(kProgress, topics.progress, kReports,
                        [this](const RobotProgressConstPtr& progress) {
                          const std::lock_guard<std::mutex> lock(mutex_);
                          news_.progress[progress->robot_id] = progress;
                        });
  listen<PlanPathsActionResult>(kResult, topics.result, 1,
                                [this](const auto& result) { take(result->result); });
}

void PlanFeed::unsubscribe() {
  // Waits for a callback that runs; it may want the mutex.
  for (Listening& listening : listening_) listening.subscriber.shutdown();
  listening_ = {};
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
