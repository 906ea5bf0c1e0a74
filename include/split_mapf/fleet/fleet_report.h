#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "split_mapf/core/grid.h"
#include "split_mapf/core/release_fraction.h"

namespace split_mapf {

/// What a robot says of itself. The values are those of RobotProgress.msg.
enum class DriveStatus : std::uint8_t {
  kOk = 0,
  kBlocked = 1,  ///< something is in its way; it gives up what was released to it
  kPaused = 2,   ///< it stands, and will go on by itself
  kLost = 3,     ///< it does not know where it is
  kFault = 4,    ///< it stands, and gives up what was released to it
};

/// A robot's progress on its route.
struct RobotReport {
  std::uint32_t sequence = 0;  ///< the number of the last visit that it has come to
  double fraction = 0;         ///< of its move out of it, 0 to 1
  DriveStatus status = DriveStatus::kOk;
  std::optional<Cell> place;             ///< the cell in which its pose lies; nothing: it gave none
  std::optional<PlanePoint> point = {};  ///< the same on a planning graph [m]
};

/// What became of a report. Only kTaken ones move the robot.
enum class ReportFate {
  kTaken,
  kBackwards,    ///< the robot has been further already
  kNotReleased,  ///< of a visit that it has no leave for
  kNoSuchVisit,  ///< of a visit that was planned away, or never was
  kNotANumber,   ///< the fraction is not a number from 0 to 1, or the status none
  kAstray,       ///< the robot is where its route does not lead
};
std::string toString(ReportFate fate);

/// Why a robot takes no part in the plan.
enum class Absence {
  kNone,     ///< it does take part
  kSilent,   ///< no report for too long
  kLost,     ///< it said so
  kFault,    ///< likewise
  kBlocked,  ///< it stands between two cells, or other ways out of its own did not help
  kAstray,   ///< it left the cells of its route
  kPaused,   ///< somebody asked for it
};
std::string toString(Absence absence);

/// Why a robot cannot be sent to its goal.
enum class GoalFault {
  kNone,
  kBlocked,  ///< the goal's cell is blocked, or a robot stands there for good
  kNoWay,    ///< the way to it is cut off
};

}  // namespace split_mapf
