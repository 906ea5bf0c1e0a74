#pragma once

#include <cstdint>
#include <mutex>
#include <string>

#include "split_mapf/core/deadline.h"
#include "split_mapf/pipeline/plan_listener.h"

namespace split_mapf {

/// What a call writes down while it runs: its clock, the seconds of its stages, its progress for
/// the caller. Pieces report from worker threads; everything else comes from the calling thread, or
/// from a worker for which that one waits.
class RunLog {
 public:
  explicit RunLog(const ProgressCallback& callback);

  void enterStage(const std::string& name);
  void leaveStage();
  /// "" outside all stages.
  const std::string& stage() const { return stage_; }
  void expectPieces(std::uint32_t count);
  void pieceDone();
  void setLowerBound(double lower_bound);
  void setPlan(std::uint32_t makespan, std::uint64_t sum_of_costs);
  double elapsedSec() const;
  /// The seconds of each stage, in order of their first begin.
  const std::vector<std::pair<std::string, double>>& stages() const { return stages_; }

 private:
  void tell();

  const ProgressCallback& callback_;
  Deadline::Clock::time_point begin_;
  Deadline::Clock::time_point stage_begin_;
  std::string stage_;
  std::vector<std::pair<std::string, double>> stages_;
  std::mutex mutex_;
  PlanProgress progress_;  // guarded by mutex_
};

}  // namespace split_mapf
