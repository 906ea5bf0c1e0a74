#include "ros/server/run_slots.h"

#include <chrono>

namespace split_mapf {
namespace {

// A stop flag cannot wake a sleeper, so that a waiting goal looks at it this often.
constexpr std::chrono::milliseconds kPollInterval(20);

}  // namespace

bool RunSlots::acquire(std::uint64_t ticket, const Deadline& deadline) {
  std::unique_lock<std::mutex> lock(mutex_);
  waiting_.insert(ticket);
  bool granted = false;
  while (!deadline.expired()) {
    granted = free_ > 0 && *waiting_.begin() == ticket;
    if (granted) break;
    changed_.wait_for(lock, kPollInterval);
  }
  waiting_.erase(ticket);
  if (granted) --free_;
  changed_.notify_all();
  return granted;
}

void RunSlots::release() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++free_;
  changed_.notify_all();
}

}  // namespace split_mapf
