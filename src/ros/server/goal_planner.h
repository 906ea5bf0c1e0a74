#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <split_mapf/MultiRobotPlan.h>
#include <split_mapf/PlanLayout.h>
#include <split_mapf/PlanPathsAction.h>

#include "ros/convert/disc_goal.h"
#include "ros/convert/map_source.h"
#include "ros/convert/options_loader.h"
#include "ros/convert/pose_transformer.h"
#include "ros/convert/robot_tasks.h"
#include "ros/server/goal_defaults.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/pipeline/planner.h"
#include "split_mapf/ros/outcome.h"
#include "split_mapf/ros/planning_grid.h"
#include "split_mapf/solvability/solvability.h"

namespace split_mapf {

/// A goal that has been read and found right.
struct PreparedGoal {
  GoalOptions options;   ///< the step's duration is known
  std::string map_hash;  ///< see hashOf()
  PlanningGrid grid;
  PlacedRobots robots;
  Instance instance;
};

/// One goal's answer.
struct GoalAnswer {
  Outcome outcome = Outcome::kInternalError;
  PlanPathsResult result;
  PlanLayout layout;  ///< of the result's plan
};

/// A plan as it is published.
struct PlanMessages {
  MultiRobotPlan plan;
  PlanLayout layout;
};

/// A preparation that its deadline ended. The text says during what: "while the map was being
/// read".
class PreparationStopped : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// From a goal message to a result message, without the action protocol. Thread-safe.
class GoalPlanner {
 public:
  /// @pre all references outlive this object.
  GoalPlanner(const Planner& planner, const GoalDefaults& defaults, bool publish_paths,
              const MapSource& maps, const PoseTransformer& transformer)
      : planner_(planner),
        defaults_(defaults),
        publish_paths_(publish_paths),
        maps_(maps),
        transformer_(transformer) {}

  /// The server's options as they are now.
  GoalOptions defaults() const { return defaults_.get(); }
  /// The goal's options with the server's where it leaves them open, checked.
  /// @throws GoalError: INVALID_OPTION, UNKNOWN_SOLVER, INVALID_SPLIT.
  GoalOptions readOptions(const PlanOptions& asked) const;
  /// Places the robots on the goal's map. @throws GoalError with every robot at fault.
  /// @throws PreparationStopped when the deadline has expired.
  PreparedGoal prepare(const boost::shared_ptr<const PlanPathsGoal>& goal,
                       const GoalOptions& options, const Deadline& deadline) const;
  /// Plans. A cancelled goal that has a plan carries it, with outcome CANCELLED.
  /// @throws GoalError: INVALID_SPLIT for a space split that does not fit the map, INVALID_OPTION
  /// for a plan with more bytes or steps than can be sent.
  GoalAnswer plan(const PreparedGoal& goal, const Deadline& deadline,
                  const PlanListener& listener) const;
  /// The messages of a plan that begins now. @pre the report has a plan.
  /// @throws GoalError: INVALID_OPTION for more bytes or steps than can be sent.
  /// @throws Interrupted when the deadline has expired; it is looked at once in some thousand
  /// cells.
  PlanMessages messagesOf(const PreparedGoal& goal, const PlanReport& report,
                          const Deadline& deadline = {}) const;

 private:
  /// @param doing  what the deadline would interrupt.
  PreparedGoal prepareUntil(const boost::shared_ptr<const PlanPathsGoal>& goal,
                            const GoalOptions& options, const Deadline& deadline,
                            const char*& doing) const;
  PreparedGoal prepareDiscs(const GoalOptions& options, PlacedDiscs discs,
                            const std::string& map_hash) const;
  /// Nothing where the goal's limit of time, or a cancel, has not left enough for them.
  std::optional<PlanMessages> messagesInTime(const PreparedGoal& goal, const PlanReport& report,
                                             const Deadline& deadline) const;
  /// Puts the messages of a plan into the answer, which says so where the deadline has come before
  /// their end. @pre the report has a plan.
  void writePlan(const PreparedGoal& goal, const PlanReport& report, const Deadline& deadline,
                 GoalAnswer& answer) const;
  /// @param points  of the robots' paths. @param least  whether these are lower bounds.
  /// @throws OptionError for a plan that could not be sent, or would outlast ROS time.
  void requireFits(const PreparedGoal& goal, const std::vector<std::uint32_t>& points,
                   bool least) const;

  const Planner& planner_;
  const GoalDefaults& defaults_;
  const bool publish_paths_;
  const MapSource& maps_;
  const PoseTransformer& transformer_;
};

/// Every obstacle to a plan, `first` among them. @pre `first` refuses the goal's instance.
std::vector<SolvabilityVerdict> refusalsOf(const PreparedGoal& goal,
                                           const SolvabilityVerdict& first,
                                           const Deadline& deadline);

/// The answer to a goal that cannot be planned for.
GoalAnswer refusal(const GoalError& error);
/// An answer without plan and faults.
GoalAnswer refusal(Outcome outcome, const std::string& message);

}  // namespace split_mapf
