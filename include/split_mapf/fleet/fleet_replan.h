#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "split_mapf/core/execution_cut.h"
#include "split_mapf/core/execution_forecast.h"
#include "split_mapf/core/execution_graph.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/fleet/fleet_report.h"
#include "split_mapf/pipeline/planner.h"
#include "split_mapf/pipeline/rest_replanner.h"

namespace split_mapf {

using Edge = std::pair<Vertex, Vertex>;  ///< the smaller one first

/// What replans of a fleet share as long as blocked cells and goals stay: the instance on the cells
/// that are open, and its distances. Used by one replan at a time.
struct FleetGround {
  FleetGround(std::shared_ptr<const Grid> open, const std::vector<Vertex>& starts,
              const std::vector<Vertex>& goals, std::vector<bool> blocked, const MotionTimes& times,
              const ReplanBudget& budget);
  FleetGround(const FleetGround&) = delete;
  FleetGround& operator=(const FleetGround&) = delete;

  Instance instance;
  std::vector<bool> blocked;  ///< by vertex
  std::vector<Edge> closed;   ///< edges, as in the question
  RestReplanner replanner;
};

/// All that a replan needs, so that it may be answered elsewhere while robots drive.
struct FleetQuestion {
  std::uint64_t version = 0;  ///< of the fleet that asks
  /// Whether the rest has to be planned anew, as the plan under execution cannot be carried out;
  /// otherwise it is improved.
  bool anew = false;
  std::shared_ptr<const Grid> grid;
  std::vector<bool> blocked;  ///< by vertex; where absent robots stand, too
  ExecutionGraph graph;
  Cut cut;                        ///< what is promised
  std::vector<bool> takes_part;   ///< by robot
  std::vector<Vertex> goals;      ///< by robot: where it is wanted
  std::vector<Vertex> joiners;    ///< where robots stand that join; their goals follow in `goals`
  std::vector<Vertex> came_from;  ///< see ReplanQuestion
  std::vector<std::uint32_t> stands;
  MotionTimes times;
  ReplanBudget budget;
  bool avoid_rings = true;
  std::shared_ptr<FleetGround> ground;  ///< of the last answer; null: none yet
  bool stalled = false;                 ///< no robot has leave to go on
  bool stalled_before = false;          ///< and a plan made anew for that has moved nobody
  /// Edges that come too near to robots that take no part, ascending; none on a grid.
  std::vector<Edge> closed_edges = {};
  double asked_sec = 0;  ///< on the caller's clock
  double step_sec = 1;

  // Of a rolling fleet.
  std::vector<bool> closed =
      {};  ///< by vertex: where no robot may be sent, whichever robot is there
  std::vector<std::uint32_t> numbers = {};  ///< by robot, those that join last: stays the same
  std::vector<bool> fresh = {};             ///< by robot: what it was going to do is of no use
  std::vector<std::uint32_t> ages = {};     ///< by robot: how long after its goal [steps]
};

struct FleetAnswer {
  std::uint64_t version = 0;  ///< of the question
  bool anew = false;
  std::optional<ExecutionGraph> execution;  ///< to go on with; nothing: go on as before
  std::vector<GoalFault> faults;            ///< anew: by robot, those that join last
  std::uint32_t rings = 0;                  ///< that stay, see ExecutionGraph
  std::string message;                      ///< why there is no plan; empty: there is one
  std::shared_ptr<FleetGround> ground;
};

/// Answers a question. Anew: every robot that takes part is planned from where its promise ends to
/// its goal, on the cells that are open; whoever has no way is brought to the nearest cell where
/// no robot wants to go. Where robots stalled before, and could only rotate, one of them or a few
/// give up their goals. What is planned is validated. Never throws for lack of a plan.
/// Thread-safe for different grounds. Cost: a plan, or the budget of a replan.
/// @param request  solver and limits of plans made anew.
FleetAnswer answerFleet(const FleetQuestion& question, const Planner& planner,
                        const PlanRequest& request, const Deadline& deadline);

/// The grid without moves to blocked cells and along the edges that are removed, if any; its
/// vertices keep their numbers. Cost: O(edges), times those removed.
std::shared_ptr<const Grid> openPart(const std::shared_ptr<const Grid>& grid,
                                     const std::vector<bool>& blocked,
                                     const std::vector<Edge>& removed = {});

}  // namespace split_mapf
