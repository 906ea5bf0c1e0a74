#include "split_mapf/ros/outcome.h"

#include <utility>

#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

std::string summarise(const std::string& first, std::size_t total) {
  if (total == 1) return first;
  std::string text = first + " (and " + counted(total - 1, "more fault");
  if (total > FaultList::kMostFaults) {
    text += "; the first " + std::to_string(FaultList::kMostFaults) + " are listed";
  }
  return text + ")";
}

}  // namespace

std::string toString(Outcome outcome) {
  switch (outcome) {
    case Outcome::kSucceeded:
      return "SUCCEEDED";
    case Outcome::kCancelled:
      return "CANCELLED";
    case Outcome::kTimeout:
      return "TIMEOUT";
    case Outcome::kUnsolvable:
      return "UNSOLVABLE";
    case Outcome::kNoPlanFound:
      return "NO_PLAN_FOUND";
    case Outcome::kMemoryLimit:
      return "MEMORY_LIMIT";
    case Outcome::kInvalidMap:
      return "INVALID_MAP";
    case Outcome::kInvalidOption:
      return "INVALID_OPTION";
    case Outcome::kUnknownSolver:
      return "UNKNOWN_SOLVER";
    case Outcome::kInvalidSplit:
      return "INVALID_SPLIT";
    case Outcome::kNoRobots:
      return "NO_ROBOTS";
    case Outcome::kDuplicateRobotId:
      return "DUPLICATE_ROBOT_ID";
    case Outcome::kOutsideMap:
      return "OUTSIDE_MAP";
    case Outcome::kBlockedCell:
      return "BLOCKED_CELL";
    case Outcome::kDuplicateStart:
      return "DUPLICATE_START";
    case Outcome::kDuplicateGoal:
      return "DUPLICATE_GOAL";
    case Outcome::kUnreachableGoal:
      return "UNREACHABLE_GOAL";
    case Outcome::kTransformFailed:
      return "TRANSFORM_FAILED";
    case Outcome::kUnplaceable:
      return "UNPLACEABLE";
    case Outcome::kInvalidPose:
      return "INVALID_POSE";
    case Outcome::kRobotLost:
      return "ROBOT_LOST";
    case Outcome::kRobotBlocked:
      return "ROBOT_BLOCKED";
    case Outcome::kUnknownRobot:
      return "UNKNOWN_ROBOT";
    case Outcome::kPreempted:
      return "PREEMPTED";
    case Outcome::kServerBusy:
      return "SERVER_BUSY";
    case Outcome::kInternalError:
      return "INTERNAL_ERROR";
  }
  throw std::logic_error("no outcome has the code " + std::to_string(codeOf(outcome)));
}

Outcome outcomeOf(Termination termination) {
  switch (termination) {
    case Termination::kSolved:
      return Outcome::kSucceeded;
    case Termination::kUnsolvable:
      return Outcome::kUnsolvable;
    case Termination::kNoPlanFound:
      return Outcome::kNoPlanFound;
    case Termination::kTimeout:
      return Outcome::kTimeout;
    case Termination::kCancelled:
      return Outcome::kCancelled;
    case Termination::kMemoryLimit:
      return Outcome::kMemoryLimit;
  }
  throw std::logic_error("a termination without an outcome");
}

RobotFault makeFault(const std::string& robot_id, Outcome code, const std::string& message) {
  RobotFault fault;
  fault.robot_id = robot_id;
  fault.code = codeOf(code);
  fault.message = message;
  return fault;
}

GoalError::GoalError(const FaultList& faults) : GoalError(faults.first(), faults.total()) {}

GoalError::GoalError(std::vector<RobotFault> faults, std::size_t total)
    : std::runtime_error(summarise(faults.front().message, total)),
      outcome_(static_cast<Outcome>(faults.front().code)),
      faults_(std::move(faults)) {}

}  // namespace split_mapf
