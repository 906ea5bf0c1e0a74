#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "split_mapf/core/execution_graph.h"
#include "split_mapf/core/fleet_snapshot.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/fleet/fleet_replan.h"
#include "split_mapf/fleet/fleet_report.h"

namespace split_mapf {

class StandingTimes;

struct FleetOptions {
  double release = 0.7071067811865476;  ///< see releaseFraction(); this one suits any robot
  bool joint_rings = false;             ///< robots of a ring begin together; false: planned away
  bool replans = true;                  ///< improve the rest of the plan again and again
  double step_sec = 1;                  ///< that a move takes
  double turn_sec = 0;                  ///< of a quarter turn in place
  double replan_period_sec = 1;
  double progress_timeout_sec = 5;  ///< of silence until a robot counts as lost
  double obstacle_time_sec = 60;    ///< for so long a cell that a robot found blocked is avoided
  std::uint32_t release_ahead = 2;  ///< visits that a robot is promised
  /// Goals come one by one, see setGoal(); questions are answered by a RollingReplanner.
  bool rolling = false;
  ReplanBudget budget;
  /// Of a planning graph: then each move has releases of its own, and `release` means nothing; with
  /// it no joint rings. Null: a grid.
  std::shared_ptr<const CloseMoves> moves;
  /// That centres keep on the planning graph [m]. Whose pose is farther than half of it from the
  /// way that is promised to it has strayed. 0: poses are not judged there.
  double distance_m = 0;
  /// Whether another plan is made where this one cannot be carried out. Without, its order stays:
  /// a robot that cannot go on stands, and it is finished when no robot can.
  bool plans_anew = true;
};
/// @throws OptionError naming what is out of range.
void requireValid(const FleetOptions& options);

/// What a robot that is not released yet waits for: another robot has to do `fraction` of its move
/// out of its visit `sequence`.
struct RouteWait {
  std::uint32_t robot = 0;
  std::uint32_t sequence = 0;
  double fraction = 0;
};

/// A visit on the route of a robot.
struct RouteStep {
  std::uint32_t sequence = 0;
  Vertex vertex = kNoVertex;
  bool released = false;         ///< it may go there, and this is never planned away
  std::vector<RouteWait> waits;  ///< what is not done yet
};

/// Where a robot stands.
struct FleetRobotStatus {
  std::uint32_t sequence = 0;
  std::uint32_t released_until = 0;
  std::optional<std::uint32_t> waits_for;  ///< another robot
  double late_sec = 0;                     ///< against the plan it set out with, by the forecast
  bool arrived = false;                    ///< where it is sent
  bool idle = false;                       ///< of a rolling fleet: it has no goal
  bool moves = false;                      ///< it has leave to go on, and takes part
  Absence absence = Absence::kNone;
  GoalFault fault = GoalFault::kNone;
};

/// Conducts a fleet that carries out a plan: takes in robots' progress, says which robots may go
/// on, and has the rest replanned when robots are late, drop out, or find cells blocked. Knows no
/// ROS and no clock: the caller tells the time, in seconds from any moment on, which never goes
/// back.
///
/// Robots obey these rules, by which none ever comes too close to another:
///  - a robot goes on only to visits that are released to it;
///  - one that says kBlocked or kFault gives up what is released to it: it ends at most the move
///    that it has begun, and goes on only to visits with numbers above all that it had been sent;
///  - reports say what was done, never what will be.
///
/// A rolling fleet has no plan to carry out: robots stand until setGoal() sends them, one by one
/// and again and again. A robot has reached its goal as soon as it has come to it; then it stays,
/// but makes room for others. Such a fleet ends when it is cancelled only.
///
/// Replans run elsewhere: ask() makes a question at times, whose answer is to be given to take().
/// Meanwhile robots go on up to the question's cut. Plans made anew replace those that cannot be
/// carried out; until one is found, every robot goes on whose way is not touched.
/// Not thread-safe. Memory: 24 bytes a visit. Cost of a report: O(log visits).
class FleetExecution {
 public:
  /// @param ids  pairwise different, one a path. @pre the plan is valid on the grid.
  /// @throws OptionError.
  FleetExecution(std::shared_ptr<const Grid> grid, std::vector<std::string> ids, const Plan& plan,
                 const FleetOptions& options, double now);
  /// Goes on with an execution whose conductor died: waits until every robot has reported, or was
  /// silent for too long, then goes on. Its step and release are those that were kept.
  /// @throws OptionError. @throws InputError when it does not fit the grid.
  FleetExecution(std::shared_ptr<const Grid> grid, const FleetSnapshot& snapshot,
                 const FleetOptions& options, double now);
  ~FleetExecution();

  // --- What happens ---
  ReportFate report(std::uint32_t robot, const RobotReport& report, double now);
  /// The robot is there, but has not begun on its route: it stands where that begins.
  void hear(std::uint32_t robot, DriveStatus status, const std::optional<Cell>& place, double now,
            const std::optional<PlanePoint>& point = {});
  /// Vertices that no robot may be sent to, beside those where absent robots stand.
  void setBlocked(const std::vector<bool>& blocked);
  /// Vertices where robots stand that are not of the fleet: no robot may be sent there either. They
  /// come and go, and are not part of a snapshot.
  void setStrangers(const std::vector<bool>& taken);
  /// Takes a robot off the floor: its cells are free. The numbers of those behind it sink by one.
  void remove(std::uint32_t robot);
  /// A robot that stands on a vertex joins with the next plan that is made anew.
  /// @return why it cannot; empty: it will.
  std::string add(const std::string& id, Vertex at, Vertex goal);
  /// One that was added does not join after all: its vertex is free. An answer that counts on it is
  /// not taken. @return whether it was to join.
  bool removeJoiner(const std::string& id);
  /// A paused robot ends what is released to it, then the others are planned around it.
  void pause(std::uint32_t robot, bool paused);
  /// No robot is promised anything more; false: every robot goes on, those paused one by one, too.
  void pauseAll(bool paused);
  /// Every robot ends what is released, and stays.
  void cancel();
  /// Of a rolling fleet: sends a robot to a vertex, wherever it was sent before; kNoVertex: it ends
  /// what is released, and is idle. Robots may have the same goal. The next question is due at
  /// once.
  void setGoal(std::uint32_t robot, Vertex goal, double now);

  /// Looks for robots that are silent or blocked for too long, and promises what can be.
  void advance(double now);
  /// What has to be replanned, if anything. @pre every question so far was answered.
  std::optional<FleetQuestion> ask(double now);
  void take(FleetAnswer answer, double now);
  /// Whether a question is out whose answer should come at once, however little it brings: it will
  /// not be taken, or the rest has to be planned anew meanwhile.
  bool isUrgent() const;

  // --- How it stands ---
  std::uint32_t robots() const { return static_cast<std::uint32_t>(robots_.size()); }
  const std::string& id(std::uint32_t robot) const { return robots_[robot].id; }
  std::optional<std::uint32_t> find(const std::string& id) const;
  /// The visits from where a robot is on, `horizon` of them beyond its promise at most.
  std::vector<RouteStep> route(std::uint32_t robot, std::uint32_t horizon) const;
  /// Robots whose routes have changed since the last call.
  std::vector<std::uint32_t> takeChanged();
  /// Of all robots. Cost: a forecast, O(visits).
  std::vector<FleetRobotStatus> status(double now) const;
  /// Whether a robot of a rolling fleet has been at its goal since it was sent there.
  bool hasReached(std::uint32_t robot) const { return robots_[robot].reached; }
  /// Whether a robot was added, and takes part with the next plan.
  bool isJoining(const std::string& id) const;
  bool isAnyJoining() const { return !joiners_.empty(); }
  /// Whether a robot is at a vertex, or was promised it.
  bool isPromised(std::uint32_t robot, Vertex vertex) const;
  double stepSec() const { return options_.step_sec; }
  Absence absence(std::uint32_t robot) const { return robots_[robot].absence; }
  GoalFault fault(std::uint32_t robot) const { return robots_[robot].fault; }
  /// By vertex: where no robot may be sent now.
  const std::vector<bool>& closed() const { return closed_; }
  /// The vertex where a robot was wanted in the first place; kNoVertex: it is idle.
  Vertex goal(std::uint32_t robot) const { return robots_[robot].goal; }
  /// The vertex that it came to last.
  Vertex vertexOf(std::uint32_t robot) const {
    return graph_.precedence()[graph_.at(robot)].vertex;
  }
  /// The vertices from the one that a robot came to last to the last one promised to it: between
  /// them it is. Cost: O(visits promised).
  std::vector<Vertex> ground(std::uint32_t robot) const;
  /// On a planning graph: where a robot is that strayed from its way [m]; nothing: it did not.
  const std::optional<PlanePoint>& strayedTo(std::uint32_t robot) const {
    return robots_[robot].strayed_to;
  }
  /// Whether nothing will happen any more: all have arrived, but those that take no part; or no
  /// plan could be made again and again, see trouble().
  bool isFinished() const;
  bool isRestoring() const { return restoring_; }
  bool isCancelled() const { return cancelled_; }
  std::uint32_t rings() const { return rings_; }
  std::uint32_t replans() const { return replans_; }
  /// Why no plan could be made anew at the last try; empty: there is one.
  std::string trouble() const;
  const ExecutionGraph& graph() const { return graph_; }
  const Cut& promised() const { return promised_; }

  /// To be kept before routes are sent, whenever snapshotVersion() has changed.
  FleetSnapshot snapshot(double now) const;
  std::uint64_t snapshotVersion() const { return snapshot_version_; }

 private:
  struct Robot {
    std::string id;
    Vertex goal = kNoVertex;
    double planned_sec = 0;
    double heard = 0;
    bool was_heard = false;
    double moved = 0;  ///< when its progress last changed
    DriveStatus status = DriveStatus::kOk;
    double status_since = 0;
    Absence absence = Absence::kNone;
    GoalFault fault = GoalFault::kNone;
    bool paused = false;
    bool void_promise = false;     ///< it stands, and waits for other visits
    bool tried_elsewhere = false;  ///< since it is blocked
    Vertex came_from = kNoVertex;
    // Where it strayed to, whether a pose told so, and on a planning graph what is near to it.
    bool was_seen_astray = false;
    Vertex place = kNoVertex;
    std::optional<PlanePoint> strayed_to;
    std::vector<Vertex> near;
    std::uint32_t next_sequence = 0;
    // Of a rolling fleet.
    std::uint32_t number = 0;  ///< its own, whoever leaves
    double goal_since = 0;
    bool reached = false;
    bool fresh = false;                    ///< its goal is new since the last answer
    RobotReport first_report;              ///< while restoring
    std::optional<std::uint32_t> held_at;  ///< likewise, see FleetSnapshot
  };
  struct Joiner {
    std::string id;
    Vertex at = kNoVertex;
    Vertex goal = kNoVertex;
  };

  struct Obstacle {
    Vertex vertex = kNoVertex;
    double until = 0;
  };

  // Reports.
  void lookForGoal(std::uint32_t robot, VisitId before);
  ReportFate takeProgress(std::uint32_t robot, const RobotReport& report, double now);
  ReportFate judgePlace(std::uint32_t robot, const RobotReport& report);
  ReportFate judgePoint(std::uint32_t robot, PlanePoint point);
  bool isOnItsWay(std::uint32_t robot, PlanePoint point) const;
  std::optional<VisitId> visitOf(std::uint32_t robot, std::uint32_t sequence) const;
  void takeStatus(std::uint32_t robot, DriveStatus status, double now);
  void dropOut(std::uint32_t robot, Absence absence);
  void comeBack(std::uint32_t robot);
  void voidPromise(std::uint32_t robot);
  void renewPromise(std::uint32_t robot);
  void settleRestored(double now);
  void promiseRestored();
  bool settleOne(std::uint32_t robot, double part, std::vector<VisitId>& targets);

  // Standing robots and cells.
  bool takesPart(std::uint32_t robot) const { return robots_[robot].absence == Absence::kNone; }
  bool isUnderWay(std::uint32_t robot) const { return graph_.progress(robot) > 0; }
  /// Whether it has leave to go on.
  bool mayMove(std::uint32_t robot) const {
    return promised_[robot] > graph_.at(robot) || isUnderWay(robot);
  }
  bool anyMayMove() const;
  bool isAnyoneHeld() const;
  /// Whether somebody asked that it be promised nothing more.
  bool isHeld(std::uint32_t robot) const {
    return all_paused_ || cancelled_ || robots_[robot].paused;
  }
  std::vector<bool> closedCells() const;
  std::vector<Edge> closedEdges() const;
  std::optional<VisitId> firstUndone(VisitId event) const;
  void openCells();
  void closeCells();
  bool leadsToClosed() const;
  void watch(double now);
  void watchBlocked(std::uint32_t robot, double now);
  void forgetObstacles(double now);
  void observeStands(double now);
  void grow(double now);

  // Replans.
  /// Whether a question is out whose answer will be taken: no robot has left since.
  bool isAwaited() const { return asked_ && question_version_ == version_; }
  FleetQuestion makeQuestion(bool anew, double now);
  std::optional<FleetQuestion> askRolling(double now);
  bool hasWork() const;
  void takeNothing(const FleetAnswer& answer, double now);
  void takeFaults(const FleetAnswer& answer, double now);
  void adopt(ExecutionGraph next, double now);
  bool renumber(std::uint32_t robot, const ExecutionGraph& next, VisitId cut,
                std::vector<std::uint32_t>& sequences);
  void welcomeJoiners(std::size_t count, double now);

  std::shared_ptr<const Grid> grid_;
  FleetOptions options_;
  MotionTimes times_;
  ExecutionGraph graph_;
  std::vector<Robot> robots_;
  std::vector<Joiner> joiners_;
  std::vector<std::uint32_t> sequences_;  ///< by visit
  Cut promised_;                          ///< by robot
  std::vector<bool> changed_;             ///< by robot: its route
  std::vector<bool> asked_blocked_;       ///< by vertex, by order of the caller
  std::vector<bool> strangers_;           ///< by vertex: where they stand
  std::vector<Obstacle> obstacles_;       ///< as robots found them
  std::vector<bool> closed_;        ///< by vertex: all of these, and where absent robots stand
  std::vector<Edge> closed_edges_;  ///< close to those on which absent robots may be, ascending
  std::unique_ptr<StandingTimes> standing_;
  std::shared_ptr<FleetGround> ground_;

  double began_ = 0;
  double observed_ = 0;
  double next_replan_ = 0;
  double next_anew_ = 0;
  std::uint32_t next_number_ = 0;
  bool incident_ = false;  ///< the rest has to be planned anew
  /// The question that is out: its cut, where robots were, and which robots stood without a
  /// promise.
  bool asked_ = false;
  bool asked_anew_ = false;
  std::uint64_t question_version_ = 0;
  Cut question_cut_;
  std::vector<VisitId> question_at_;
  std::vector<bool> question_void_;
  std::vector<bool> question_fresh_;
  std::size_t question_joiners_ = 0;
  std::uint64_t question_openings_ = 0;
  std::uint64_t openings_ = 0;  ///< times that cells may have been opened
  bool was_advanced_ = false;   ///< so that promises were given
  bool restoring_ = false;
  std::uint32_t restored_ahead_ = 0;
  bool all_paused_ = false;
  bool cancelled_ = false;
  std::uint64_t version_ = 0;
  std::uint64_t snapshot_version_ = 1;
  std::uint32_t rings_ = 0;
  std::uint32_t replans_ = 0;
  std::uint32_t failed_ = 0;  ///< plans anew in a row
  std::uint32_t stalls_ = 0;  ///< plans anew since anybody moved
  std::uint64_t questions_ = 0;
  std::string trouble_;
};

}  // namespace split_mapf
