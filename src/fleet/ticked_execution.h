#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/delays.h"
#include "split_mapf/core/execution_forecast.h"
#include "split_mapf/core/execution_graph.h"
#include "split_mapf/core/grid.h"

namespace split_mapf {

/// Robots that carry out an execution graph in simulated time, a tick at a time: each that may go
/// on does, unless it is delayed. Not thread-safe. Cost: O(robots under way) a tick.
class TickedExecution {
 public:
  /// @param steps  of the plan, by event: nobody begins one before all have ended the one before;
  /// empty: everybody goes on as the graph allows.
  TickedExecution(const Grid& grid, ExecutionGraph graph, const MotionTimes& times,
                  std::vector<std::uint32_t> steps = {});

  void tick(const Delays& delays);
  /// Goes on with another plan behind what is under way. @pre made by concatenate() from graph().
  void goOnWith(ExecutionGraph graph);

  const ExecutionGraph& graph() const { return graph_; }
  bool isDone() const { return under_way_.empty(); }
  /// Robots that have visits to come, in order.
  const std::vector<std::uint32_t>& underWay() const { return under_way_; }
  /// The tick at which a robot last came to a vertex.
  std::uint32_t arrival(std::uint32_t robot) const { return arrivals_[robot]; }
  /// From where each robot came to where it is; kNoVertex: it has not moved.
  const std::vector<Vertex>& cameFrom() const { return came_from_; }
  Vertex vertexOf(std::uint32_t robot) const { return order()[graph_.at(robot)].vertex; }
  /// Where it is on its way to; where it stands: its vertex.
  Vertex nextOf(std::uint32_t robot) const {
    return ticks_[robot] > 0 ? order()[graph_.at(robot) + 1].vertex : vertexOf(robot);
  }
  double progress(std::uint32_t robot) const {
    return static_cast<double>(ticks_[robot]) / times_.move;
  }
  /// The vertex that it holds: the next one once it has let go of the one behind it.
  Vertex heldVertex(std::uint32_t robot) const {
    return ticks_[robot] >= release_ticks_ && ticks_[robot] > 0 ? nextOf(robot) : vertexOf(robot);
  }

 private:
  enum class Decision : std::uint8_t { kOpen, kGo, kStay };

  const Precedence& order() const { return graph_.precedence(); }
  void decide(std::uint32_t robot, const Delays& delays);
  Decision decideAlone(std::uint32_t robot, const Delays& delays) const;
  Decision decideByCloseMoves(std::uint32_t robot, VisitId event) const;
  std::uint32_t leaderOf(std::uint32_t robot) const;
  void advance(std::uint32_t robot);
  void faceNext(std::uint32_t robot);
  void report(std::uint32_t robot, double fraction);

  static constexpr std::uint32_t kNobody = 0xffffffffU;

  const Grid& grid_;
  ExecutionGraph graph_;
  MotionTimes times_;
  std::vector<std::uint32_t> steps_;  // of the plan, in lockstep
  std::uint32_t release_ticks_;       // of a move, until the vertex behind is free
  std::uint32_t now_ = 0;
  std::uint32_t barrier_ = 0;           // step of the plan that is under way
  std::vector<std::uint32_t> ticks_;    // by robot: of its move, done
  std::vector<std::uint32_t> turning_;  // by robot: ticks until it faces the next vertex
  std::vector<Vertex> facing_;          // by robot: what it turns to
  std::vector<Vertex> came_from_;
  std::vector<std::uint32_t> arrivals_;
  std::vector<Decision> decisions_;
  std::vector<std::uint32_t> under_way_;
  std::vector<std::uint32_t> chain_;
  std::vector<std::uint32_t> goers_;  // in this tick, leaders before those that follow them
};

}  // namespace split_mapf
