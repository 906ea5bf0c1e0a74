#pragma once

#include <cstdint>
#include <deque>
#include <mutex>

#include <ros/callback_queue_interface.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <split_mapf/RobotProgress.h>

namespace split_mapf {

/// What robots have said on the topic `progress` since it was read last, the oldest first. Reports
/// are put in by the thread that roscpp receives them in: to wake another one for each of them
/// costs more than what they tell. Thread-safe.
class ReportInbox {
 public:
  using Reports = std::deque<RobotProgress::ConstPtr>;

  explicit ReportInbox(const ros::NodeHandle& node);
  ~ReportInbox() { subscriber_.shutdown(); }
  ReportInbox(const ReportInbox&) = delete;
  ReportInbox& operator=(const ReportInbox&) = delete;

  /// Empties it.
  Reports take();

 private:
  /// Calls right away, in the thread in which a message was received.
  struct AtOnce : ros::CallbackQueueInterface {
    void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) override;
    /// Nothing waits here.
    void removeByID(std::uint64_t /*owner*/) override {}
  };

  void put(const RobotProgress::ConstPtr& report);

  std::mutex mutex_;
  Reports reports_;
  AtOnce at_once_;
  ros::Subscriber subscriber_;  ///< last: it uses the others
};

}  // namespace split_mapf
