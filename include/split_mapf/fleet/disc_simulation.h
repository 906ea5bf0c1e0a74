#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/fleet/simulation.h"
#include "split_mapf/pipeline/disc_problem.h"
#include "split_mapf/roadmap/courses.h"

namespace split_mapf {

/// What came of a plan of robots that have size.
struct DiscSimulationReport {
  SimulationReport paths;      ///< on the planning graph: between the legs, from its step 0 on
  double departure_steps = 0;  ///< that the legs onto the graph took
  double arrival_steps = 0;    ///< and those off it; 0 where robots did not get so far
  std::vector<std::uint32_t> unfinished;  ///< robots that are not at their poses
  /// Where each robot was at every tick, legs included, on the raster.
  std::vector<Course> courses;
  std::uint32_t ticks_per_step = 1;
};

/// Executes a plan of robots that have size as simulate() does: the legs onto the planning graph by
/// their order, then the paths by the policy, when all robots are on the graph, then the legs off
/// it, when all paths have ended. Every move and leg takes a step at least. What was executed is
/// checked by checkDiscs() in continuous time, robots that did not arrive included.
/// @param plan  for problem.instance(). @param options  `moves` is found here; `on_tick` is not
/// called. @throws as simulate(), and InputError as orderLegs().
DiscSimulationReport simulateDiscs(const DiscProblem& problem, const Plan& plan,
                                   const SimulationOptions& options,
                                   const Deadline& deadline = Deadline());

}  // namespace split_mapf
