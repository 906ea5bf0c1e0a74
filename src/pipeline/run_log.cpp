#include "pipeline/run_log.h"

#include <algorithm>

namespace split_mapf {
namespace {

double secondsSince(Deadline::Clock::time_point begin) {
  return std::chrono::duration<double>(Deadline::Clock::now() - begin).count();
}

}  // namespace

RunLog::RunLog(const ProgressCallback& callback)
    : callback_(callback), begin_(Deadline::Clock::now()), stage_begin_(begin_) {}

void RunLog::enterStage(const std::string& name) {
  leaveStage();
  stage_ = name;
  stage_begin_ = Deadline::Clock::now();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    progress_.stage = name;
  }
  tell();
}

void RunLog::leaveStage() {
  if (stage_.empty()) return;
  const double seconds = secondsSince(stage_begin_);
  const auto known = std::find_if(stages_.begin(), stages_.end(),
                                  [this](const auto& entry) { return entry.first == stage_; });
  if (known == stages_.end()) {
    stages_.emplace_back(stage_, seconds);
  } else {
    known->second += seconds;
  }
  stage_.clear();
}

void RunLog::expectPieces(std::uint32_t count) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    progress_.subproblems_done = 0;
    progress_.subproblems_total = count;
  }
  tell();
}

void RunLog::pieceDone() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++progress_.subproblems_done;
  }
  tell();
}

void RunLog::setLowerBound(double lower_bound) {
  const std::lock_guard<std::mutex> lock(mutex_);
  progress_.proved_lower_bound = lower_bound;
}

void RunLog::setPlan(std::uint32_t makespan, std::uint64_t sum_of_costs) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    progress_.makespan = makespan;
    progress_.sum_of_costs = sum_of_costs;
  }
  tell();
}

double RunLog::elapsedSec() const { return secondsSince(begin_); }

void RunLog::tell() {
  if (!callback_) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  callback_(progress_);
}

}  // namespace split_mapf
