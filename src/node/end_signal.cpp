#include "node/end_signal.h"

#include <chrono>
#include <csignal>
#include <string>
#include <thread>

#include <XmlRpcValue.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/xmlrpc_manager.h>

namespace split_mapf {
namespace {

volatile std::sig_atomic_t end_signalled = 0;

extern "C" void noteSignal(int /*signal*/) { end_signalled = 1; }

/// What the master calls for `rosnode kill`, and when another node takes this one's name.
void noteShutdownCall(XmlRpc::XmlRpcValue& parameters, XmlRpc::XmlRpcValue& result) {
  if (parameters.getType() == XmlRpc::XmlRpcValue::TypeArray && parameters.size() > 1) {
    ROS_WARN("told to end: %s", std::string(parameters[1]).c_str());
  }
  end_signalled = 1;
  result = ros::xmlrpc::responseInt(1, "", 0);
}

}  // namespace

void installEndSignal() {
  std::signal(SIGINT, noteSignal);
  std::signal(SIGTERM, noteSignal);
  const ros::XMLRPCManagerPtr& calls = ros::XMLRPCManager::instance();
  calls->unbind("shutdown");
  calls->bind("shutdown", noteShutdownCall);
}

bool endSignalled() { return end_signalled != 0 || !ros::ok(); }

void waitForEndSignal() {
  while (!endSignalled()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

}  // namespace split_mapf
