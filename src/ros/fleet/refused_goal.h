#pragma once

#include "split_mapf/ros/outcome.h"

namespace split_mapf {

/// Ends a goal that was not begun: rejected where the server is busy, else accepted and aborted, as
/// then only its result says why. @param goal  a goal handle of an action server.
template <typename Result, typename Goal>
void refuseGoal(Goal& goal, const GoalError& error) {
  Result result;
  result.outcome = codeOf(error.outcome());
  result.message = error.what();
  result.faults = error.faults();
  if (error.outcome() == Outcome::kServerBusy) {
    goal.setRejected(result, result.message);
    return;
  }
  goal.setAccepted();
  goal.setAborted(result, result.message);
}

}  // namespace split_mapf
