#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "split_mapf/core/grid.h"

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
};

}  // namespace split_mapf
