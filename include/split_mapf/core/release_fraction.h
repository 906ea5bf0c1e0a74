#pragma once

namespace split_mapf {

/// A place in the plane [m].
struct PlanePoint {
  double x = 0;
  double y = 0;
};

/// The part of its move out of a cell that a robot must have done before another disc of the same
/// size may set out for that cell, so that the two never come closer than twice their radius,
/// whatever either does afterwards: 2 r / c. With progress p of the leader and q of the follower
/// their squared distance is at least (1 - q)^2 + p^2 cells where the directions are at right
/// angles, and (1 - q + p)^2 where the leader goes straight on; neither is below p^2.
/// @param robot_radius [m] >= 0. @param cell_size [m] > 0.
/// @throws OptionError when the cell is smaller than 2 sqrt(2) r: on diagonally adjacent edges two
/// discs would meet even so.
double releaseFraction(double robot_radius, double cell_size);

/// The same for two edges of a planning graph: the leader goes from `via` to `to`, the follower
/// from `from` to `via`. The distance between a place on the leader's edge and the follower's edge
/// never falls as the leader goes on (it is convex along the edge, and 0 at `via`), so the smallest
/// fraction at which it is `distance` will do.
/// @param distance  [m] to keep between the centres, twice the radius and the clearance.
/// @return a fraction, above 1 when the distance is not kept even at the edge's end: the follower
/// then has to wait for more than this move. @pre from, via and to differ pairwise from `via`.
double releaseFraction(PlanePoint from, PlanePoint via, PlanePoint to, double distance);

}  // namespace split_mapf
