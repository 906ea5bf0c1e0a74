#include "rviz/replay_link.h"

#include <exception>
#include <utility>

#include <ros/service.h>
#include <split_mapf/ReplayControl.h>

namespace split_mapf {

ReplayLink::ReplayLink(std::function<void(const std::string&)> said)
    : said_(std::move(said)), thread_([this] { work(); }) {}

ReplayLink::~ReplayLink() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void ReplayLink::setService(const std::string& service) {
  const std::lock_guard<std::mutex> lock(mutex_);
  service_ = service;
  commands_.clear();
}

void ReplayLink::send(std::uint8_t command, double value) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (service_.empty()) return;
    const bool again = !commands_.empty() && commands_.back().command == command &&
                       command == ReplayControl::Request::SEEK;
    if (again) commands_.pop_back();
    commands_.push_back({command, value});
  }
  changed_.notify_all();
}

void ReplayLink::work() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ending_ || !commands_.empty(); });
    if (ending_) return;
    const Command command = commands_.front();
    commands_.pop_front();
    const std::string service = service_;
    lock.unlock();
    call(service, command);
    lock.lock();
  }
}

void ReplayLink::call(const std::string& service, Command command) {
  ReplayControl control;
  control.request.command = command.command;
  control.request.value = command.value;
  try {
    if (!ros::service::call(service, control)) {
      said_("no replay_node answers on " + service);
    } else {
      said_(control.response.ok ? "" : "replay_node: " + control.response.message);
    }
  } catch (const std::exception& error) {
    said_(error.what());
  }
}

}  // namespace split_mapf
