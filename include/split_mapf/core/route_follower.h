#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/release_fraction.h"

namespace split_mapf {

/// How a robot moves. 0 for acceleration or turn rate: at once.
struct RobotMotion {
  double speed = 1;         ///< [m/s] > 0
  double acceleration = 0;  ///< [m/s^2], also of braking
  double turn_rate = 0;     ///< [rad/s] in place
};

/// A visit of a route in the plane.
struct RouteLeg {
  std::uint32_t sequence = 0;
  PlanePoint point;
  bool released = false;
};

/// A robot without hardware: follows a route in straight lines, turns in place, speeds up and slows
/// down so that it can always stop at the end of what is released. Not thread-safe.
class RouteFollower {
 public:
  RouteFollower(PlanePoint start, double heading, const RobotMotion& motion)
      : motion_(motion), at_(start), heading_(heading) {}

  /// Takes a route up: another one, or the same with more of it released. One that does not lead
  /// through the visit to which the robot came last is left out. @param fresh  a route of another
  /// plan: its first visit is where the robot stands. @return whether it was taken up.
  bool take(const std::vector<RouteLeg>& route, bool fresh);
  /// Moves on for some seconds. @param holds  whether it stands still by itself.
  void advance(double seconds, bool holds);
  /// Gives up what is released, but for the move that has begun: from now on only visits with
  /// numbers above all that it knows are taken up.
  void giveUp();

  std::uint32_t sequence() const { return sequence_; }
  /// Of the move out of that visit, below 1.
  double fraction() const;
  PlanePoint position() const;
  double heading() const { return heading_; }  ///< [rad]
  double speed() const { return speed_; }
  bool hasRoute() const { return has_route_; }
  /// Whether more of its route is released than it has done.
  bool mayMove() const { return !ahead_.empty() && ahead_.front().released; }
  /// Whether it is at the end of its route.
  bool isDone() const { return has_route_ && ahead_.empty(); }
  /// The visits to come.
  const std::vector<RouteLeg>& ahead() const { return ahead_; }

 private:
  double legLength() const;
  bool turnsToNext(double& seconds);
  double roomAhead() const;
  void go(double seconds);

  RobotMotion motion_;
  PlanePoint at_;  // the last visit, or where it began
  double heading_;
  double speed_ = 0;
  double done_ = 0;  // [m] of the way to the next visit
  std::uint32_t sequence_ = 0;
  std::uint32_t given_up_ = 0;  // numbers below are void
  std::uint32_t known_ = 0;     // the first number that it never saw
  bool has_route_ = false;
  std::vector<RouteLeg> ahead_;
};

}  // namespace split_mapf
