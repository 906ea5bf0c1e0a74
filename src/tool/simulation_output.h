#pragma once

#include <iosfwd>
#include <vector>

#include "split_mapf/core/instance.h"
#include "split_mapf/fleet/disc_simulation.h"
#include "split_mapf/fleet/simulation.h"
#include "split_mapf/roadmap/map_frame.h"

namespace split_mapf::tool {

/// Writes what came of an execution as one JSON object, with the keys of the public interface.
void writeSimulationJson(std::ostream& out, const Instance& instance,
                         const SimulationOptions& options, const SimulationReport& report);

/// The same of robots that have size: `paths` names cells of the map; besides `departure_steps` and
/// `arrival_steps` that the legs took, `poses`, a point [x, y] in the map's frame for each part of
/// a step, legs included, and `poses_per_step`. `unfinished` are robots that are not at their
/// poses.
void writeDiscSimulationJson(std::ostream& out, const Instance& instance, const MapFrame& frame,
                             const SimulationOptions& options, const DiscSimulationReport& report);

/// The same as the result file of the League of Robot Runners 3.1, which its viewer PlanViz reads:
/// rows before columns, a letter a step (U, D, L, R, W), delays as [first step, first step after].
/// Each robot has one task, its goal.
void writeLeagueJson(std::ostream& out, const Instance& instance, const SimulationReport& report);

}  // namespace split_mapf::tool
