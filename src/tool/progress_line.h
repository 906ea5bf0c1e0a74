#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "split_mapf/core/deadline.h"
#include "split_mapf/pipeline/planner.h"

namespace split_mapf::tool {

/// One line on standard error that says how far planning has come, redrawn a few times a second
/// and wiped at the end.
class ProgressLine {
 public:
  explicit ProgressLine(Deadline::Clock::time_point begin_of_call);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// Takes the latest news. Thread-safe, and cheap enough for every piece.
  void update(const PlanProgress& progress);
  /// Wipes the line and draws no more.
  void finish();

 private:
  void run();
  void draw();

  Deadline::Clock::time_point begin_of_call_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool finished_ = false;
  PlanProgress progress_;
  std::size_t drawn_ = 0;  // characters on the line
  std::thread thread_;
};

}  // namespace split_mapf::tool
