#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "split_mapf/pipeline/planner.h"
#include "split_mapf/split/decomposition.h"
#include "split_mapf/split/split_options.h"
#include "split_mapf/split/split_spec.h"

namespace split_mapf {

/// A request whose every option has been read and found right.
struct CheckedRequest {
  PlanRequest asked;
  std::string solver;  ///< what `auto` stands for, or as asked
  SolverOptions solver_options;
  SplitSpec split;  ///< never kAuto
  SplitOptions split_options;
};

/// Reads a request. @throws UnknownSolverError, SplitSpecError, OptionError.
CheckedRequest check(const PlanRequest& request, const SolverRegistry& solvers);

/// One call of Planner::plan(): its clock, its progress, its report.
class PlanRun {
 public:
  PlanRun(const Instance& instance, CheckedRequest request, const SolverRegistry& solvers,
          Executor& executor, const Deadline& deadline, const ProgressCallback& progress);
  PlanReport run();

 private:
  void runStages();
  void enterStage(const std::string& name);
  void leaveStage();
  bool computeDistances();
  bool reportCutOff();
  std::optional<Decomposition> split();
  /// Solves the leaves and stitches their plans. False when a piece has no plan; `report_` then
  /// says why the whole ended.
  bool solve(const Decomposition& tree);
  void solvePiece(const Decomposition& leaf, const Deadline& deadline, SolveResult& result,
                  SubproblemReport& row);
  bool takeResults(const Decomposition& tree, std::vector<SolveResult>& results);
  void accept(Plan plan);
  void interrupt();
  double elapsedSec() const;
  void tell();

  const Instance& instance_;
  CheckedRequest request_;
  Executor& executor_;
  const Deadline& deadline_;
  const ProgressCallback& callback_;
  Deadline::Clock::time_point begin_;
  std::unique_ptr<Solver> solver_;
  PlanReport report_;

  Deadline::Clock::time_point stage_begin_;
  std::mutex progress_mutex_;
  PlanProgress progress_;
};

}  // namespace split_mapf
