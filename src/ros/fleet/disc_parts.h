#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nav_msgs/OccupancyGrid.h>
#include <split_mapf/MultiRobotPlan.h>

#include "ros/convert/options_loader.h"
#include "split_mapf/core/close_moves.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/roadmap/disc_ground.h"
#include "split_mapf/roadmap/leg_order.h"
#include "split_mapf/ros/outcome.h"
#include "split_mapf/ros/planning_grid.h"

namespace split_mapf {

/// A part of an execution: a plan of robots on a ground of their own.
struct FleetPart {
  std::shared_ptr<const Grid> grid;
  std::shared_ptr<const CloseMoves> moves;
  std::vector<std::string> ids;
  Plan plan;
  bool plans_anew = true;          ///< see FleetOptions
  std::vector<RobotFault> faults;  ///< of robots that are not moved in it
};

/// A robot that was left behind in an earlier part: it is somewhere on this way, on the raster.
using LeftOut = std::vector<PlanePoint>;

/// A robot that was not in the plan, and joins on the planning graph.
struct JoiningDisc {
  std::string id;
  Vertex goal = kNoVertex;          ///< the vertex to which it goes
  PlanePoint place;                 ///< and from there straight to this one, on the raster [m]
  std::string obstacle;             ///< why it could not join so far; empty: it was not tried
  std::optional<PlanePoint> start;  ///< on the raster, where it stands that gives no poses
};

/// A plan of robots that have size as three executions, one after the other: the legs onto the
/// planning graph, the paths on it, and the legs off it. The graph is built anew from the map, the
/// plan's radius and clearance, and the node's cell_size and passages. Immutable.
class DiscParts {
 public:
  static constexpr std::uint32_t kParts = 3;

  /// @pre isOnRoadmap(plan). @throws GoalError for a plan that is not valid, or not on that graph;
  /// InputError as buildRoadmap() and orderLegs(). Cost: as buildRoadmap().
  DiscParts(const MultiRobotPlan& plan, const nav_msgs::OccupancyGrid& map,
            const GoalOptions& options);

  const MapGeometry& geometry() const { return geometry_; }
  /// Between centres, and between a centre and what is not free [m].
  double distance() const { return distance_m_; }
  double reach() const { return reach_m_; }
  double radius() const { return radius_m_; }  ///< of the largest robot [m]
  /// Where robots that join stand.
  const DiscGround& ground() const { return *ground_; }
  PlanePoint placeOf(Vertex v) const { return moves_->place(v); }
  /// The vertex from which a robot drives straight to a place of the raster, at most so far as
  /// ~snap_distance allows; nothing where there is none.
  std::optional<Vertex> vertexFor(PlanePoint place) const;
  /// Whether the way onto the graph of one of these robots comes too near to a place; which one's.
  std::optional<std::string> whoComesNear(PlanePoint place,
                                          const std::vector<std::string>& robots) const;
  /// Why a robot cannot end where it wants to: one of the others drives off the graph too near to
  /// its vertex, or ends too near to its own way off the graph. Empty: it can.
  /// @param others  those that take part.
  std::string whyNot(const JoiningDisc& robot, const std::vector<std::string>& others) const;
  /// The same with another robot, which the last part leads off the graph when all others have
  /// gone. One that was taken off the floor may come again, to another goal. Robots beyond the plan
  /// are numbered as they came last: who joins those again in that order gets the same parts.
  /// @pre whyNot() is empty.
  std::shared_ptr<const DiscParts> with(const JoiningDisc& robot) const;
  /// One part, for the robots that are to go on. In the last one robots whose legs come near to
  /// those left out stay where they are. @throws InputError as orderLegs().
  FleetPart part(std::uint32_t number, const std::vector<std::string>& ids,
                 const std::vector<LeftOut>& left_out) const;

 private:
  void requireValid(const MultiRobotPlan& plan, const ObstacleRaster& raster) const;
  DrivenLeg homeOf(const JoiningDisc& robot) const;
  void readRobots(const MultiRobotPlan& plan);
  void forget(std::size_t index);
  FleetPart legs(bool at_goal, const std::vector<std::uint32_t>& robots,
                 const std::vector<LeftOut>& left_out) const;
  bool comesNear(const DrivenLeg& leg, const LeftOut& way) const;

  std::shared_ptr<const DiscGround> ground_;
  MapGeometry geometry_;
  std::shared_ptr<const Grid> grid_;
  std::shared_ptr<const CloseMoves> moves_;
  std::vector<std::string> ids_;
  std::size_t of_plan_ = 0;  // of them, the others have joined
  Plan plan_;
  std::vector<DrivenLeg> away_;  // by robot
  std::vector<DrivenLeg> home_;
  double radius_m_ = 0;  // of the largest
  double clearance_m_ = 0;
  double snap_distance_m_ = 0;
  double distance_m_ = 0;
  double reach_m_ = 0;
};

/// A plan as it is kept: what is executed of it, without moments and stamped poses. Plans that are
/// executed alike have equal bytes.
std::string bytesOf(MultiRobotPlan plan);

}  // namespace split_mapf
