#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "split_mapf/core/close_moves.h"
#include "split_mapf/core/precedence.h"

namespace split_mapf {

/// What became of a report of a robot's progress. All but kTaken change nothing.
enum class ReportOutcome {
  kTaken,
  kBackwards,    ///< the robot has been further already
  kNotReleased,  ///< the robot is where it must not be yet
  kNoSuchVisit,  ///< of another robot, or none at all
};

/// What events have to wait for on a planning graph.
struct CloseWaits {
  struct Wait {
    VisitId awaited = kNoVisit;
    float fraction = 0;  ///< of that event's move
  };
  std::vector<std::uint32_t> first;  ///< by event, and their number behind the last one
  std::vector<Wait> all;
};

/// A plan under execution: the order of its events, where the robots are, and which robots may go
/// on. Times play no part: robots may be late by any delay.
///
/// The rule. A robot may begin a move once the robot whose visit comes before at that vertex has
/// done the *release fraction* of its move out of it (see releaseFraction()); at fraction 0, once
/// it begins to leave, as long as the follower never gets ahead of it (a convoy). The robots of a
/// ring begin together, and all stop when one stops (a joint move): with any fraction above 0 none
/// of them could ever begin otherwise.
///
/// Why this is safe, by parts that the tests take one by one:
/// (a) Edges never go back in plan time, and what they close within a step are exactly the rings;
///     with these taken as one the graph has no cycle (see Precedence).
/// (b) Hence, if every move that has begun ends, some robot may always go on until all have
///     arrived: no deadlock, whatever the delays.
/// (c) A robot holds its vertex until its release and enters one only after the release of the
///     visit before, so no vertex is ever held by two; robots on disjoint edges are a cell apart,
///     and those that follow each other are apart by the choice of the fraction.
/// (d) What is put behind a downward-closed cut is a graph of its own behind this one: every edge
///     between the two points back. So their concatenation has (a) to (c), see execution_cut.h.
/// (e) With a fraction above 0 a ring never begins but as a joint move.
///
/// On a planning graph (CloseMoves) a move also waits for other robots' moves that come close to it
/// and go before it, each with a fraction of its own: of every close move for the last time that it
/// is made before, as whoever makes it has waited for those who made it earlier. Which goes first
/// is the order of the plan; of moves of one step those that others follow. So no cycle arises: (a)
/// and (b) hold as they are. (c): of two robots under way on close edges one began after the other
/// had done its fraction; one that stands on a vertex is far from all edges that do not touch it.
///
/// Source: Hoenig et al., ICAPS 2016 and IROS 2019; ours: one edge an event, release by a fraction
/// of a move. Not thread-safe; const members are. Memory: 20 bytes an event, and 8 a robot; on a
/// planning graph 8 more for each move that an event waits for.
class ExecutionGraph {
 public:
  /// All robots are at their starts. @pre 0 <= release <= 1. Cost: O(events).
  ExecutionGraph(Precedence precedence, double release);
  /// The same on a planning graph. Steps of the order become those of inOneOrder().
  /// @param moves  of the graph; null: `release` holds for all of them. @pre visits of a robot that
  /// follow one another are neighbours.
  ExecutionGraph(Precedence precedence, double release, std::shared_ptr<const CloseMoves> moves);

  const Precedence& precedence() const { return precedence_; }
  /// On a planning graph 1: each move has fractions of its own.
  double release() const { return release_; }
  /// Of a planning graph; null: there is none.
  const std::shared_ptr<const CloseMoves>& closeMoves() const { return moves_; }
  const std::vector<Ring>& rings() const { return rings_; }
  /// The ring that an event is part of; null: none.
  const Ring* ringOf(VisitId event) const;

  /// The last visit that a robot has come to.
  VisitId at(std::uint32_t robot) const { return places_[robot].at; }
  /// The part of its move into the next visit that is done, below 1; 0: it has not set out.
  float progress(std::uint32_t robot) const { return places_[robot].progress; }
  bool isDone(std::uint32_t robot) const { return at(robot) == precedence_.last(robot); }
  /// Calls visit(awaited event, fraction) for every event of another robot of which so much has to
  /// be done before this one may begin; but for those that rotate with it. On a planning graph what
  /// the robot's own event before had to wait for is left out.
  template <typename Visitor>
  void forEachAwaited(VisitId event, const Visitor& visit) const {
    if (!moves_) {
      const VisitId awaited = precedence_.awaits(event);
      if (awaited != kNoVisit) visit(awaited, release_);
      return;
    }
    for (std::uint32_t i = waits_.first[event]; i < waits_.first[event + 1]; ++i) {
      visit(waits_.all[i].awaited, static_cast<double>(waits_.all[i].fraction));
    }
  }
  /// Whether so much of an event is done; at fraction 0: whether it has begun. O(1).
  bool hasDone(VisitId event, double fraction) const;
  /// Whether the move into a visit has come so far that the vertex behind is free. O(1).
  bool hasLeft(VisitId event) const;
  /// Whether the other robots let this event begin. O(1), of a ring's event O(robots of the ring).
  bool isReleased(VisitId event) const;

  /// The robot is on its way into a visit, and has passed those before. @param fraction  of the
  /// move, 0 to 1; 1: it has arrived. @param freed  the events of other robots that had to wait for
  /// this one and need not any more are added, but for those of rings, see isReleased(); null: not
  /// wanted, as it has to be on a planning graph. O(1), and as much again for each visit passed
  /// over.
  ReportOutcome report(std::uint32_t robot, VisitId visit, double fraction,
                       std::vector<VisitId>* freed = nullptr);

  /// The robot is under way from its first visit already, by leave of an execution that this one
  /// goes on with. @pre it is at its first visit and has a second one.
  void resume(std::uint32_t robot, float progress) { places_[robot].progress = progress; }
  /// The same for a robot that has come to one of its visits meanwhile.
  void resumeAt(std::uint32_t robot, VisitId visit, float progress) {
    places_[robot] = {visit, progress};
  }

 private:
  struct Place {
    VisitId at = 0;
    float progress = 0;
  };

  bool waitsAreOver(VisitId event) const;

  Precedence precedence_;
  double release_;
  std::shared_ptr<const CloseMoves> moves_;
  CloseWaits waits_;           // on a planning graph
  std::vector<Place> places_;  // by robot
  std::vector<Ring> rings_;
  std::unordered_map<VisitId, std::uint32_t> ring_of_;
};

}  // namespace split_mapf
