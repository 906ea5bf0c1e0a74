#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include <ros/node_handle.h>

namespace split_mapf {

/// Hands on to a replay_node what somebody steers here, in order, from a thread of its own: a node
/// that does not answer holds nobody up. Thread-safe.
class ReplayLink {
 public:
  /// @param said  called on that thread with what went wrong; empty: all is well again.
  explicit ReplayLink(std::function<void(const std::string&)> said);
  ReplayLink(const ReplayLink&) = delete;
  ReplayLink& operator=(const ReplayLink&) = delete;
  /// Leaves what has not been sent.
  ~ReplayLink();

  /// The node's service ~control; empty: no link.
  void setService(const std::string& service);
  /// A command of ReplayControl.srv. Of two SEEKs that wait, the later counts.
  void send(std::uint8_t command, double value = 0);

 private:
  struct Command {
    std::uint8_t command;
    double value;
  };
  void work();
  void call(const std::string& service, Command command);

  std::function<void(const std::string&)> said_;
  ros::NodeHandle node_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string service_;
  std::deque<Command> commands_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace split_mapf
