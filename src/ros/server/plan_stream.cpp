#include "ros/server/plan_stream.h"

#include <utility>

namespace split_mapf {

void PlanStream::offer(const PlanReport& report) {
  auto copy = std::make_shared<const PlanReport>(report);
  const std::lock_guard<std::mutex> lock(waiting_mutex_);
  waiting_ = std::move(copy);
}

void PlanStream::publishDue(Clock::time_point now) {
  const std::unique_lock<std::mutex> lock(publishing_, std::try_to_lock);
  if (!lock.owns_lock() || closed_) return;
  if (has_published_ && now - last_ < kPeriod) return;
  std::shared_ptr<const PlanReport> report;
  {
    const std::lock_guard<std::mutex> waiting(waiting_mutex_);
    report.swap(waiting_);
  }
  if (!report) return;
  has_published_ = true;
  last_ = now;
  publish_(*report);
}

void PlanStream::close() {
  const std::lock_guard<std::mutex> lock(publishing_);
  closed_ = true;
  const std::lock_guard<std::mutex> waiting(waiting_mutex_);
  waiting_.reset();
}

}  // namespace split_mapf
