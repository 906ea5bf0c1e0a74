#include "node/run_node.h"

#include <csignal>
#include <exception>

#include "node/end_signal.h"

namespace split_mapf {

namespace {

// Time for the last results to leave the node.
constexpr double kFlushSec = 0.1;

}  // namespace

void serve(std::uint32_t threads, const std::string& ready, const std::function<void()>& end) {
  ros::AsyncSpinner spinner(threads);
  spinner.start();
  ROS_INFO("%s", ready.c_str());
  waitForEndSignal();
  if (end) {
    end();
    ros::WallDuration(kFlushSec).sleep();
  }
  spinner.stop();
}

int runNode(int argc, char** argv, const char* name, void (*run)(NodeContext&)) {
  // A file that grows beyond a limit, as a log may, is an error of writing, as on a full disk, and
  // no end. Threads of roscpp have this signal blocked, all others not.
  std::signal(SIGXFSZ, SIG_IGN);
  ros::init(argc, argv, name, ros::init_options::NoSigintHandler);
  // Keeps ROS, and with it the log, alive until an error has been told.
  const ros::NodeHandle node;
  int code = 0;
  try {
    NodeContext context;
    installEndSignal();
    ros::param::get(context.private_node.getNamespace(), context.parameters);
    run(context);
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    code = 1;
  }
  ros::shutdown();
  return code;
}

}  // namespace split_mapf
