#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <split_mapf/RobotFault.h>

#include "split_mapf/core/termination.h"
#include "split_mapf/ros/fault_list.h"

namespace split_mapf {

/// How a goal of PlanPaths ended; the values are the constants of PlanOutcome.msg.
enum class Outcome : std::int32_t {
  kSucceeded = 0,
  kCancelled = 1,
  kTimeout = 2,
  kUnsolvable = 3,
  kNoPlanFound = 4,
  kMemoryLimit = 5,
  kInvalidMap = 10,
  kInvalidOption = 11,
  kUnknownSolver = 12,
  kInvalidSplit = 13,
  kNoRobots = 20,
  kDuplicateRobotId = 21,
  kOutsideMap = 22,
  kBlockedCell = 23,
  kDuplicateStart = 24,
  kDuplicateGoal = 25,
  kUnreachableGoal = 26,
  kTransformFailed = 27,
  kUnplaceable = 28,
  kInvalidPose = 29,
  kRobotLost = 30,
  kRobotBlocked = 31,
  kUnknownRobot = 32,
  kPreempted = 33,
  kServerBusy = 40,
  kInternalError = 50,
};

constexpr std::int32_t codeOf(Outcome outcome) { return static_cast<std::int32_t>(outcome); }
/// The name of the constant in PlanOutcome.msg, e.g. "TIMEOUT".
std::string toString(Outcome outcome);
Outcome outcomeOf(Termination termination);

/// One robot's fault as a message.
RobotFault makeFault(const std::string& robot_id, Outcome code, const std::string& message);

/// A goal that cannot be planned for: its outcome, and every robot at fault at once.
class GoalError : public std::runtime_error {
 public:
  GoalError(Outcome outcome, const std::string& message)
      : std::runtime_error(message), outcome_(outcome) {}
  /// The outcome is the first fault's, the message its message with the number of further ones.
  /// @pre faults is not empty.
  explicit GoalError(const FaultList& faults);

  Outcome outcome() const { return outcome_; }
  const std::vector<RobotFault>& faults() const { return faults_; }

 private:
  GoalError(std::vector<RobotFault> faults, std::size_t total);

  Outcome outcome_;
  std::vector<RobotFault> faults_;
};

}  // namespace split_mapf
