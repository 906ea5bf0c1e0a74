#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// Index of a visit in its Precedence. The visits of a robot have consecutive ones.
using VisitId = std::uint32_t;
/// Marks the absence of a visit.
constexpr VisitId kNoVisit = 0xffffffffU;

/// One unbroken visit of a robot to a vertex: 20 bytes, with the edges of the precedence graph in
/// it. The move into the visit is the *event* of the same id.
struct Visit {
  Vertex vertex = kNoVertex;
  std::uint32_t robot = 0;
  std::uint32_t step = 0;     ///< at which the plan begins it
  VisitId before = kNoVisit;  ///< the visit to the same vertex directly before, of another robot
  VisitId after = kNoVisit;   ///< the one directly after
};

/// A plan without its waits: which visits the robots make, and in which order they come to each
/// vertex. Any schedule that keeps both orders is free of collisions; the plan is one of them.
///
/// The event of a visit follows two others: the event of the same robot's visit before, and the
/// event that ends the visit `before`, by which its robot leaves the vertex. No other edge is
/// needed, as the visits to a vertex follow one another. Edges never go back in plan time. Events
/// of the same step depend on each other only where robots follow each other; "enters the vertex
/// that robot X leaves in this step" has at most one X for each robot, so such chains end, or close
/// to *rings* of robots that rotate. With each ring taken as one the graph has no cycle.
/// Source: Hoenig et al., ICAPS 2016 (temporal plan graph), reduced to consecutive visits.
/// Immutable, hence safe to share between threads. Memory: 20 bytes a visit.
class Precedence {
 public:
  /// @param vertices  size of the graph. @pre the plan is valid. Cost: O(entries of the paths).
  /// @throws Interrupted when the deadline has expired.
  Precedence(const Plan& plan, std::uint32_t vertices, const Deadline& deadline = {});
  /// From visits that are known. @param visits  robot by robot in order, with vertex, robot and
  /// step. @pre each robot from 0 on has one; the steps are those of a valid plan.
  static Precedence fromVisits(std::vector<Visit> visits, std::uint32_t vertices);

  std::uint32_t robots() const { return static_cast<std::uint32_t>(first_.size() - 1); }
  std::uint32_t vertices() const { return vertices_; }
  /// Number of visits of all robots.
  std::uint32_t size() const { return static_cast<std::uint32_t>(visits_.size()); }
  const Visit& operator[](VisitId visit) const { return visits_[visit]; }
  /// A robot's visit to its start.
  VisitId first(std::uint32_t robot) const { return first_[robot]; }
  /// A robot's visit to the last vertex of its path.
  VisitId last(std::uint32_t robot) const { return first_[robot + 1] - 1; }
  bool isFirst(VisitId visit) const { return visit == first_[visits_[visit].robot]; }
  bool isLast(VisitId visit) const { return visit + 1 == first_[visits_[visit].robot + 1]; }
  /// The event of another robot that the event of a visit has to follow; kNoVisit: of none.
  VisitId awaits(VisitId visit) const {
    const VisitId before = visits_[visit].before;
    return before == kNoVisit ? kNoVisit : before + 1;
  }
  /// The event of another robot that has to follow the event of a visit; kNoVisit: none.
  VisitId awaitedBy(VisitId visit) const {
    return isFirst(visit) ? kNoVisit : visits_[visit - 1].after;
  }
  /// All visits, ordered by the step at which the plan begins them. Cost: O(visits).
  std::vector<VisitId> inPlanOrder() const;
  /// Calls `visitor` with each visit, in this order. They lie far from each other in memory, so
  /// that those who come soon are fetched ahead.
  template <typename Visitor>
  void forEachInPlanOrder(const Visitor& visitor) const {
    const std::vector<VisitId> order = inPlanOrder();
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (i + kAhead < order.size()) __builtin_prefetch(&visits_[order[i + kAhead]]);
      visitor(order[i]);
    }
  }

 private:
  static constexpr std::size_t kAhead = 12;

  Precedence(std::vector<Visit>&& visits, std::uint32_t vertices, const Deadline& deadline);
  void link(const Deadline& deadline);

  std::uint32_t vertices_;
  std::vector<Visit> visits_;
  std::vector<VisitId> first_;  // by robot, and the number of all behind the last
};

/// The same order with a step of its own for each visit, but one for those of a ring: of the visits
/// of a step those that others follow come first. Orders that are taken from it stay as they are
/// when visits are left out. Cost: O(visits).
Precedence inOneOrder(const Precedence& precedence);

/// Robots that rotate in one step of a plan: each moves to the vertex that the next one leaves, the
/// last to the first one's. Their events, in this order.
using Ring = std::vector<VisitId>;
/// All rings of a plan, by step. Cost: O(visits).
std::vector<Ring> findRings(const Precedence& precedence);

/// The earliest step of every event when a move takes one step and a vertex may be entered in the
/// step in which it is left, or `headway` steps later; rings move together. Robot i begins no move
/// before step `departures[i]` (empty: 0 for all), so its first one ends a step later at the
/// soonest.
/// @return a step for each visit; that of a robot's first one is 0. Cost: O(visits).
/// @throws Interrupted when the deadline has expired.
std::vector<std::uint32_t> earliestSteps(const Precedence& precedence,
                                         const std::vector<std::uint32_t>& departures = {},
                                         const Deadline& deadline = {}, std::uint32_t headway = 0);

/// The plan in which every visit begins at its step. @pre the steps keep all orders; a robot's
/// first visit begins at 0.
Plan planOf(const Precedence& precedence, const std::vector<std::uint32_t>& steps);

}  // namespace split_mapf
