#include "ros/server/server_diagnostics.h"

#include <boost/algorithm/string/join.hpp>

#include <ros/console.h>

#include "core/resident_memory.h"
#include "split_mapf/plugin/methods.h"
#include "split_mapf/ros/outcome.h"

namespace split_mapf {

ServerDiagnostics::ServerDiagnostics(const ros::NodeHandle& node,
                                     const ros::NodeHandle& private_node, const PlanServer& server,
                                     QueueLimits limits, std::uint32_t workers,
                                     const RemoteWorkers* remote)
    : server_(server),
      limits_(limits),
      workers_(workers),
      remote_(remote),
      updater_(node, private_node) {
  updater_.setHardwareID("none");
  updater_.add("planner",
               [this](diagnostic_updater::DiagnosticStatusWrapper& status) { fill(status); });
  timer_ = node.createWallTimer(ros::WallDuration(1.0),
                                [this](const ros::WallTimerEvent&) { updater_.force_update(); });
}

std::string ServerDiagnostics::troubleElsewhere() {
  if (remote_ == nullptr) return "";
  std::string trouble = remote_->trouble();
  if (trouble == trouble_) return trouble;
  if (trouble.empty()) ROS_INFO("workers: their server can be reached again");
  if (!trouble.empty()) ROS_WARN("workers: %s; pieces are solved here", trouble.c_str());
  trouble_ = trouble;
  return trouble;
}

void ServerDiagnostics::fill(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const std::string trouble = troubleElsewhere();
  const PlanServerStatus now = server_.status();
  if (now.last_outcome == toString(Outcome::kInternalError)) {
    status.summary(DiagnosticStatus::ERROR, "the last goal met an internal error");
  } else if (abandonedCalls() > 0) {
    status.summary(DiagnosticStatus::WARN, "a search of a plug-in does not stop");
  } else if (now.queued + now.running >= limits_.admitted) {
    status.summary(DiagnosticStatus::WARN, "the queue is full");
  } else if (!trouble.empty()) {
    status.summary(DiagnosticStatus::WARN, "workers elsewhere cannot be asked: " + trouble);
  } else if (now.running > 0) {
    status.summary(DiagnosticStatus::OK, "planning");
  } else {
    status.summary(DiagnosticStatus::OK, "ready");
  }
  status.add("goals running", now.running);
  status.add("goals queued", now.queued);
  status.add("goals allowed", limits_.admitted);
  status.add("goals finished", now.finished);
  status.add("workers", workers_);
  if (remote_ != nullptr) {
    const RemoteWorkers::Tally tally = remote_->tally();
    status.add("pieces asked of workers elsewhere", tally.asked);
    status.add("pieces answered by workers elsewhere", tally.answered);
  }
  status.add("plug-in searches that do not stop", abandonedCalls());
  status.add("last outcome", now.last_outcome);
  status.add("last message", now.last_message);
  status.add("last outcomes", boost::algorithm::join(now.outcomes, ", "));
  status.addf("last runtime [s]", "%.3f", now.last_runtime_sec);
  status.addf("memory [MiB]", "%.1f", residentMemoryMib());
}

}  // namespace split_mapf
