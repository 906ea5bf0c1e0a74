#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "split_mapf/core/grid.h"
#include "split_mapf/core/release_fraction.h"

namespace split_mapf {

/// An execution as it is kept for the case that who conducts it dies. What robots were promised
/// follows from the visits and from where robots are, but for those that were held.
struct FleetSnapshot {
  struct Visit {
    std::uint32_t sequence = 0;
    Cell cell;
    std::uint32_t step = 0;  ///< orders the visits of a cell
  };
  struct Robot {
    std::string id;
    Cell goal;
    double planned_sec = 0;  ///< its arrival by the plan, from the beginning
    bool paused = false;
    std::uint32_t next_sequence = 0;  ///< the first number that no visit of it ever had
    std::vector<Visit> visits;        ///< from where it is on
    /// The number of the last visit promised to a robot that is held; nothing: it is not.
    std::optional<std::uint32_t> held_at = std::nullopt;
  };
  /// A robot that did not come to the end of an earlier part.
  struct LeftBehind {
    std::string id;
    std::vector<PlanePoint> way;  ///< it is somewhere on it [m]
    bool removed = false;         ///< it has been taken off the floor since
  };
  /// Why a robot did not come to its goal in an earlier part.
  struct Fault {
    std::string id;
    std::int32_t code = 0;
    std::string message;
  };
  /// A robot that was added to a plan of robots that have size.
  struct Joined {
    std::string id;
    PlanePoint place;    ///< its goal [m]
    bool waits = false;  ///< it is to join, and is not among the robots yet
    std::optional<PlanePoint> start = std::nullopt;  ///< where it stands that gives no poses [m]
  };
  /// Of a plan of robots that have size, which is executed in parts: what the ground of the present
  /// part is built from. What else is kept is of that part.
  struct Part {
    std::string plan;  ///< all of it, in bytes that who keeps it can read
    std::uint32_t number = 0;
    double elapsed_sec = 0;        ///< since the beginning of the first part
    double planned_sec = 0;        ///< of all parts
    std::vector<std::string> ids;  ///< of the robots that it began with
    std::vector<LeftBehind> left_behind;
    std::vector<Fault> faults;
    std::vector<Joined> joined = {};
  };
  std::string plan_id;
  std::uint32_t width = 0;  ///< of the grid [cells]
  std::uint32_t height = 0;
  double elapsed_sec = 0;  ///< since the beginning
  double step_sec = 1;
  double release = 0;
  std::uint32_t release_ahead = 0;
  bool all_paused = false;
  bool cancelled = false;
  bool rolling = false;  ///< without goals: who gave them has to give them again
  std::vector<Cell> blocked;
  std::vector<Robot> robots;
  std::optional<Part> part = std::nullopt;
};

}  // namespace split_mapf
