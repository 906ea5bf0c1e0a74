#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/all_distances.h"
#include "pipeline/checked_request.h"
#include "pipeline/piece_solver.h"
#include "pipeline/repair_loop.h"
#include "pipeline/run_log.h"
#include "pipeline/step_table.h"
#include "split_mapf/portfolio/instance_features.h"
#include "split_mapf/solvability/solvability.h"
#include "split_mapf/split/splitter.h"
#include "split_mapf/split/time_split.h"

namespace split_mapf {

/// One call of Planner::plan(): its stages, from the instance to the validated plan.
class PlanRun {
 public:
  PlanRun(const Instance& instance, CheckedRequest request, const SolverRegistry& solvers,
          Executor& executor, const Deadline& deadline, const PlanListener& listener);
  PlanReport run();

 private:
  void runStages();
  /// The distance tables and, where `auto` must choose, what it imagines of the robots' ways; and
  /// the ways that a split in time cuts.
  bool computeDistances();
  /// The seed of these, where there is such a split.
  std::optional<std::uint64_t> seedOfWays() const;
  /// Whether the answer is the shortest path of a robot that is alone. @pre it is not cut off.
  bool acceptShortestPath();
  /// True, with the reason in the report, when no plan exists.
  bool reportUnsolvable();
  /// @pre no robot is cut off.
  void setLowerBounds();
  /// Whether there are pieces. Split `auto` makes none.
  bool splits() const;
  /// Whether solver `auto` is asked for.
  bool mustChoose() const;
  /// Puts a solver where `auto` was asked for. @pre no robot is cut off.
  void choose();
  /// Of the split that the request asks for by now.
  std::unique_ptr<Splitter> makeSplitter();
  /// From the split to a plan of the whole; nothing, with the verdict in the report, without one.
  std::optional<Plan> planInPieces();
  /// Splits, and solves the pieces; nothing when the deadline cut the split.
  std::optional<RepairLoop::Outcome> solvePieces(Splitter& splitter);
  /// What `auto` chose came to nothing: puts another solver in its place, for the whole. False when
  /// there is a plan or a proof, or no other solver is left.
  bool callAnother(const RepairLoop::Outcome& outcome);
  /// Joins the pieces' plans and mends the seams.
  Plan join(const Splitter& splitter, RepairLoop::Outcome& outcome);
  bool isSplitByPlugin() const;
  /// @throws SplitterFailure where a plug-in's pieces do not fit together.
  void requireJoined(const Plan& plan) const;
  void takeVerdict(const SolveResult& result);
  void accept(Plan plan);
  /// Says how good the plan is. @pre there is one.
  void judge();
  /// A small knot that `auto` solved is worth a short search for the optimum, or its proof.
  void searchOptimum();
  /// What `auto` finds for the other objective, where it serves this one better.
  void takeFromOther();
  /// A crowd whose plan came soon and is dear gets another, by a search that takes longer.
  void guideCrowdAgain(const Deadline& end);
  void refineUntil(const Deadline& end);
  void takeTurnsOut();
  /// True, with the reason in the report, when the solver would keep one that no memory holds.
  bool refuseStepTables();
  /// Likewise, when `auto` can choose nobody, as there is memory neither for a table of steps nor
  /// for the distances of all robots.
  bool refuseEverybody();
  /// The same by what is known before any robot's way is: on wide maps these take minutes.
  bool refuseAtSight();
  /// Takes note of what somebody has proved for the objective [steps]. @pre there is a plan.
  void raiseBound(std::uint64_t bound, const std::string& by);
  void interrupt();
  /// Values of what `auto` calls: lean ones where memory is short or the plan is to be seen soon.
  std::map<std::string, std::string> valuesOf(const std::string& solver) const;
  /// Has a plan made to be seen when what `auto` chose is late, where there is memory for two.
  void planWhenLate();
  void planMeanwhile();
  /// The plan that was made meanwhile is the answer, if there is one.
  void keepPlanOfMeanwhile(const std::string& why);
  /// What `auto` chose gets all the time but what the last resort is likely to need.
  void keepTimeForLastResort(double expected_sec);

  const Instance& instance_;
  CheckedRequest request_;
  Executor& executor_;
  const Deadline& deadline_;
  Deadline solve_deadline_;         ///< of what `auto` chose: earlier, so that others get a turn
  const Deadline finish_deadline_;  ///< of what is done to a plan that was found in time
  RunLog log_;
  const BetterPlanCallback& better_plan_;
  std::optional<SolvabilityChecker> checker_;  ///< from stage "check" on
  const SolverRegistry& solvers_;
  const SolverTable traits_;
  StepTable step_table_;           ///< known by rows and columns first, then by lower bounds
  AllDistances all_distances_;     ///< likewise
  const std::string last_resort_;  ///< a solver; empty: there is none
  PieceSolver piece_solver_;
  std::vector<Path> shortest_paths_;                ///< of the robots, until `auto` has chosen
  std::vector<Path> ways_;                          ///< of the robots, until they are cut in time
  std::optional<InstanceFeatures> features_;        ///< set where `auto` had to choose
  std::string solver_said_;                         ///< of the plan of an unsplit instance
  std::optional<std::vector<std::string>> others_;  ///< that `auto` can still call, last first
  std::string choice_;                              ///< why, for people
  std::optional<std::uint64_t> sum_at_proof_;       ///< when the plan was proved optimal
  std::optional<Plan> for_other_;                   ///< the worse of two first plans
  std::string refined_sum_;                         ///< what became of it, for people
  PlanReport report_;
};

}  // namespace split_mapf
