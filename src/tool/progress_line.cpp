#include "tool/progress_line.h"

#include <algorithm>
#include <chrono>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace split_mapf::tool {
namespace {

constexpr std::chrono::milliseconds kPeriod(200);

}  // namespace

ProgressLine::ProgressLine(Deadline::Clock::time_point begin_of_call)
    : begin_of_call_(begin_of_call) {
  progress_.stage = "reading";
  thread_ = std::thread([this] { run(); });
}

ProgressLine::~ProgressLine() { finish(); }

void ProgressLine::update(const PlanProgress& progress) {
  const std::lock_guard<std::mutex> lock(mutex_);
  progress_ = progress;
}

void ProgressLine::finish() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (finished_) return;
    finished_ = true;
  }
  wake_.notify_all();
  thread_.join();
  std::cerr << '\r' << std::string(drawn_, ' ') << '\r' << std::flush;
}

void ProgressLine::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  // Once at least, however soon the call has ended.
  do {
    draw();
    wake_.wait_for(lock, kPeriod, [this] { return finished_; });
  } while (!finished_);
}

void ProgressLine::draw() {
  const std::chrono::duration<double> elapsed = Deadline::Clock::now() - begin_of_call_;
  std::ostringstream line;
  line << std::fixed << std::setprecision(1) << elapsed.count() << " s  " << progress_.stage;
  if (progress_.subproblems_total > 0) {
    line << "  " << progress_.subproblems_done << " of " << progress_.subproblems_total
         << (progress_.subproblems_total == 1 ? " piece" : " pieces");
  }
  if (progress_.makespan > 0) line << "  makespan " << progress_.makespan;
  const std::string text = line.str();
  std::cerr << '\r' << text << std::string(drawn_ - std::min(drawn_, text.size()), ' ')
            << std::flush;
  drawn_ = text.size();
}

}  // namespace split_mapf::tool
