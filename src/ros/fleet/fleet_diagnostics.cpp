#include "ros/fleet/fleet_diagnostics.h"

#include "core/resident_memory.h"

namespace split_mapf {
namespace {

// Share of the cells from which on throughput falls, whatever is planned.
constexpr double kCrowded = 0.4;

}  // namespace

FleetDiagnostics::FleetDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                                   const FleetServer& server)
    : server_(server), updater_(node, private_node) {
  updater_.setHardwareID("none");
  updater_.add("fleet",
               [this](diagnostic_updater::DiagnosticStatusWrapper& status) { fill(status); });
  timer_ = node.createWallTimer(ros::WallDuration(1.0),
                                [this](const ros::WallTimerEvent&) { updater_.force_update(); });
}

void FleetDiagnostics::fill(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  using diagnostic_msgs::DiagnosticStatus;
  const FleetServerStatus now = server_.status();
  if (!now.trouble.empty()) {
    status.summary(DiagnosticStatus::ERROR, now.trouble);
  } else if (now.plan_id.empty()) {
    status.summary(DiagnosticStatus::OK, "idle");
  } else if (now.restoring) {
    status.summary(DiagnosticStatus::WARN, "waits for all robots to report after a restart");
  } else if (now.absent + now.without_way > 0) {
    status.summary(DiagnosticStatus::WARN, "robots take no part or have no way, see ~state");
  } else if (now.rolling && now.fullness > kCrowded) {
    status.summary(
        DiagnosticStatus::WARN,
        "robots stand on more than 40 % of the free cells, which slows all of them down; "
        "see parameter ~max_active");
  } else {
    status.summary(DiagnosticStatus::OK, now.rolling ? "conducting" : "executing");
  }
  status.add("plan", now.plan_id);
  status.add("robots", now.robots);
  status.add("robots arrived", now.arrived);
  status.add("robots that take no part", now.absent);
  status.add("robots without a way", now.without_way);
  status.add("goals", now.goals);
  status.add("robots with a goal", now.active);
  status.add("robots with a goal at most", now.max_active);
  status.add("tasks that wait", now.waiting);
  status.addf("share of cells with robots", "%.3f", now.fullness);
  status.add("rings that stay", now.rings);
  status.add("replans", now.replans);
  status.addf("last replan [s]", "%.3f", now.last_replan_sec);
  status.add("reports", now.reports);
  status.add("reports refused", now.refused);
  status.add("reports of others", now.of_others);
  status.add("last report refused", now.last_refused);
  status.addf("memory [MiB]", "%.1f", residentMemoryMib());
}

}  // namespace split_mapf
