#include "ros/fleet/report_inbox.h"

#include <utility>

#include <ros/console.h>

namespace split_mapf {
namespace {

constexpr std::uint32_t kMostReports = 20000;  // two seconds of a thousand robots

}  // namespace

void ReportInbox::AtOnce::addCallback(const ros::CallbackInterfacePtr& callback,
                                      std::uint64_t /*owner*/) {
  callback->call();
}

ReportInbox::ReportInbox(const ros::NodeHandle& node) {
  ros::NodeHandle reports(node);
  reports.setCallbackQueue(&at_once_);
  subscriber_ = reports.subscribe("progress", kMostReports, &ReportInbox::put, this,
                                  ros::TransportHints().tcpNoDelay());
}

void ReportInbox::put(const RobotProgress::ConstPtr& report) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (reports_.size() == kMostReports) {
    reports_.pop_front();
    ROS_WARN_THROTTLE(5, "reports of robots are lost: more than %u wait", kMostReports);
  }
  reports_.push_back(report);
}

ReportInbox::Reports ReportInbox::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(reports_, {});
}

}  // namespace split_mapf
