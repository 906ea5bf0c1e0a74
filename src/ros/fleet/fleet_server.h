#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <tuple>
#include <unordered_map>
#include <vector>

#include <actionlib/server/action_server.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/service_server.h>
#include <ros/wall_timer.h>
#include <split_mapf/AddRobot.h>
#include <split_mapf/BlockCells.h>
#include <split_mapf/ExecutePlanAction.h>
#include <split_mapf/PauseRobots.h>
#include <split_mapf/RemoveRobot.h>
#include <split_mapf/RobotProgress.h>

#include "ros/convert/fleet_options.h"
#include "ros/convert/map_source.h"
#include "ros/convert/pose_transformer.h"
#include "ros/fleet/disc_parts.h"
#include "ros/fleet/move_action.h"
#include "ros/fleet/move_goals.h"
#include "ros/fleet/report_inbox.h"
#include "ros/fleet/rolling_ground.h"
#include "split_mapf/fleet/fleet_execution.h"
#include "split_mapf/fleet/fleet_tasks.h"
#include "split_mapf/fleet/rolling_replan.h"
#include "split_mapf/ros/outcome.h"
#include "split_mapf/ros/planning_grid.h"

namespace split_mapf {

/// What the fleet server is doing, for diagnostics.
struct FleetServerStatus {
  std::string plan_id;  ///< empty: it is idle
  bool restoring = false;
  std::uint32_t robots = 0;
  std::uint32_t arrived = 0;
  std::uint32_t absent = 0;
  std::uint32_t without_way = 0;
  std::uint32_t rings = 0;
  std::uint32_t replans = 0;
  double last_replan_sec = 0;
  std::uint64_t reports = 0;
  std::uint64_t refused = 0;    ///< reports that cannot be
  std::uint64_t of_others = 0;  ///< of robots or plans that are not executed
  std::string last_refused;
  // Of ~move.
  bool rolling = false;
  std::size_t goals = 0;     ///< that are not over
  std::uint32_t active = 0;  ///< robots that have a goal and go there
  std::uint32_t max_active = 0;
  std::size_t waiting = 0;  ///< tasks that do not begin yet
  double fullness = 0;      ///< share of the free cells on which robots stand
  std::string trouble;      ///< why something cannot be done; empty: nothing is wrong
};

/// The ROS side of FleetExecution: translates messages, tells the time, keeps the execution in a
/// file. Actions ~execute, and ~move where no plan is executed; topics `progress` (in),
/// <robot>/route (latched), ~routes (those of all robots; who subscribes is sent the present ones),
/// ~state; services ~block_cells, ~remove_robot, ~add_robot, ~pause. Thread-safe.
class FleetServer {
 public:
  /// @pre all outlive this object.
  FleetServer(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
              const FleetServerOptions& options, const MapSource& maps, const Planner& planner,
              const PoseTransformer& transformer);
  ~FleetServer();
  FleetServer(const FleetServer&) = delete;
  FleetServer& operator=(const FleetServer&) = delete;

  FleetServerStatus status() const;
  /// Ends the goal that runs; the execution stays in its file, for the next start.
  void shutdown();

 private:
  /// Vertices near to blocked cells, and what they were found for.
  struct NearBlocked {
    std::shared_ptr<const CloseMoves> moves;
    double reach_m = 0;
    std::vector<std::uint32_t> cells;
    std::vector<bool> vertices;
  };
  using Server = actionlib::ActionServer<ExecutePlanAction>;
  using Goal = Server::GoalHandle;
  using Lock = std::unique_lock<std::mutex>;

  /// A robot that reports, of the fleet or not.
  struct Known {
    double heard = 0;
    geometry_msgs::PoseStamped pose;  ///< the last one; an empty frame: it gave none
    std::optional<Cell> place;        ///< on the present grid
    /// On the map, as its pose tells; where it has none the place is all that is known.
    std::optional<geometry_msgs::Point> point;
    std::uint8_t status = RobotProgress::OK;

    bool hasPose() const { return !pose.header.frame_id.empty(); }
  };
  /// A plan that is right, and waits for its robots to report, or for an older one to end.
  struct Waiting {
    Goal goal;
    MultiRobotPlan message;
    PlanningGrid grid;
    FleetOptions options;
    std::shared_ptr<const DiscParts> discs;  ///< of robots that have size; else null
    double since = 0;
  };

  // The action.
  void takeGoal(Goal goal);
  void takeCancel(const Goal& goal);
  Waiting check(const Goal& goal) const;
  bool isTheSame(const MultiRobotPlan& plan) const;
  void beginWhenReady(double now);
  void changeGrid(const PlanningGrid& grid);
  std::vector<RobotFault> notReady(const Waiting& waiting, double now) const;
  std::string whyOffStart(const DiscParts& discs, const RobotPath& path, const Known& known) const;
  Waiting checkDiscs(const Goal& goal) const;
  void requireNames(const MultiRobotPlan& plan) const;
  void begin(const Waiting& waiting, double now);
  void beginPart(const std::vector<std::string>& ids, double now);
  void enterPart(const FleetPart& part);
  FleetPart partOf(const std::vector<std::string>& ids);
  void keepPart(FleetSnapshot& kept) const;
  void takeUpFleet(const FleetSnapshot& kept, double now);
  FleetPart takeUpPart(const FleetSnapshot::Part& kept, const nav_msgs::OccupancyGrid& map);
  bool goOnToNextPart(const std::vector<FleetRobotStatus>& status, double now);
  bool isLastPart() const { return !discs_ || part_ + 1 == DiscParts::kParts; }
  void leaveOut(std::uint32_t robot, const std::vector<FleetRobotStatus>& status);
  void nameThoseLeft(const std::vector<FleetRobotStatus>& status);
  void closeLeftOut();
  void setFleet(std::unique_ptr<FleetExecution> fleet);
  void takeUpAgain(double now);
  void endWhenFinished(double now);
  void keepPlaces();
  void end(const ExecutePlanResult& result);

  // The action ~move: a rolling fleet, which robots join as they report.
  void takeMove(MoveAction::Goal goal);
  void takeMoveCancel(const MoveAction::Goal& goal);
  void roll(double now);
  FleetOptions rollingOptions(const RollingGround& ground) const;
  void startTasks();
  bool hasNewMap() const;
  void joinReporting(double now);
  MoveTask readTask(const RobotTask& task, std::size_t index, bool is_twice, double now);
  std::optional<RobotFault> faultOfRobot(const RobotTask& task, const std::string& name,
                                         double now);
  void conductTasks(double now);
  void pulse();

  // Robots.
  void takeReports();
  void takeProgress(const RobotProgress& message);
  void locate(Known& known) const;
  std::optional<Cell> placeOf(const geometry_msgs::PoseStamped& pose) const;
  std::optional<Cell> cellAt(const std::optional<geometry_msgs::Point>& point) const;
  Cell cellUnder(PlanePoint place) const;
  std::optional<PlanePoint> rasterPoint(const std::optional<geometry_msgs::Point>& point) const;
  std::optional<geometry_msgs::Point> poseOnMap(const geometry_msgs::PoseStamped& pose) const;
  void countRefused(const RobotProgress& message, const std::string& why);
  void closeCells();
  void markNear(std::vector<bool>& cells, Cell cell, double distance_m);
  void markUnder(std::vector<bool>& cells, const geometry_msgs::Point& point);
  const std::vector<bool>& nearBlocked(double reach_m);
  void reindex();

  // Services.
  bool blockCells(BlockCells::Request& request, BlockCells::Response& response);
  bool removeRobot(RemoveRobot::Request& request, RemoveRobot::Response& response);
  bool addRobot(AddRobot::Request& request, AddRobot::Response& response);
  bool pauseRobots(PauseRobots::Request& request, PauseRobots::Response& response);
  std::string tryToAdd(const RobotTask& task);
  std::string tryToEnlist(const RobotTask& task, const Known& known);
  std::string tryToJoinPlan(const RobotTask& task, const Known& known);
  std::string tryToJoinDiscs(const RobotTask& task, const Known& known);
  bool takeBack(const std::string& id);
  std::string whoseTopic(const std::string& id) const;
  bool isWaitingToJoin(const std::string& id) const;
  std::string readStart(const RobotTask& task, const Known& known, JoiningDisc& robot) const;
  std::string standsOnVertex(const std::optional<PlanePoint>& start, const Known& known,
                             Vertex& at) const;
  void placeAtStart(const JoiningDisc& robot);
  std::string readGoal(const RobotTask& task, Vertex at, JoiningDisc& robot) const;
  std::string whyNoEnd(const JoiningDisc& robot) const;
  std::string waitToJoin(const JoiningDisc& robot, Vertex at);
  std::string joinPart(const JoiningDisc& robot, Vertex at);
  void letWaitingJoin(double now);
  void nameThoseNotJoined();
  void nameThoseWaiting();
  void keepJoined(FleetSnapshot::Part& part) const;
  void takeUpJoined(const FleetSnapshot::Part& kept);
  std::string tryToJoin(const RobotTask& task, const Known& known);
  std::string whyNot(Cell place) const;

  // As time goes by.
  void tick();
  void askLocked(double now);
  /// @param windows  null: of a fleet that carries out a plan.
  void replan(const FleetQuestion& question, RollingReplanner* windows, std::uint64_t epoch,
              const std::shared_ptr<StopFlag>& hurry);
  void keepLocked(double now);
  void publishRoutes(double now);
  void publishState(double now);
  void welcome(const ros::SingleSubscriberPublisher& subscriber);
  double now();

  const FleetServerOptions options_;
  const MapSource& maps_;
  const Planner& planner_;
  const PoseTransformer& transformer_;
  ros::NodeHandle node_;
  ReportInbox reports_;

  mutable std::mutex mutex_;
  std::unique_ptr<FleetExecution> fleet_;
  std::optional<PlanningGrid> grid_;
  /// Of robots that have size: the parts of their execution, which of them runs, with what options,
  /// and who was left behind in those before.
  std::shared_ptr<const DiscParts> discs_;
  std::uint32_t part_ = 0;
  FleetOptions part_options_;
  std::map<std::string, LeftOut> left_out_;
  /// Which robots the part began with, who had been left behind by then, and the plan's bytes: what
  /// its ground is built from after a restart.
  std::vector<std::string> part_ids_;
  std::map<std::string, LeftOut> part_left_out_;
  std::string discs_plan_;
  std::vector<bool> left_out_cells_;  ///< by vertex of the part
  /// Robots that were added to the plan: those that are to join when all are on the graph, and
  /// those that were let in, of which discs_ knows.
  std::vector<JoiningDisc> joining_next_;
  std::vector<JoiningDisc> joined_;
  /// What is near to cells, by column, row and distance, as far as it was asked for on a graph.
  std::map<std::tuple<std::int32_t, std::int32_t, double>, std::vector<Vertex>> near_;
  std::shared_ptr<const CloseMoves> near_of_;
  NearBlocked near_blocked_;
  std::vector<RobotFault> faults_;
  bool all_paused_ = false;
  std::set<std::string> paused_;
  std::optional<Goal> goal_;  ///< that is being executed; nothing: taken up again without one
  std::optional<Waiting> waiting_;
  std::string plan_id_;
  std::uint64_t epoch_ = 0;
  double began_ = 0;
  double planned_sec_ = 0;
  bool kept_may_exist_ = false;  ///< an execution in the file has not been looked for yet
  std::uint64_t kept_version_ = 0;
  std::set<std::uint32_t> blocked_;  ///< cells, as in RobotPath.cells
  std::map<std::string, Known> known_;
  // Of a rolling fleet, null of another one.
  std::optional<RollingGround> ground_;
  std::shared_ptr<RollingReplanner> replanner_of_windows_;
  std::unique_ptr<FleetTasks> tasks_;
  std::unique_ptr<MoveGoals> moves_;
  std::shared_ptr<const nav_msgs::OccupancyGrid> rolls_on_;  ///< the map
  std::set<std::string> removed_;  ///< robots that join again when they are added only
  std::unordered_map<std::string, std::uint32_t> index_;  ///< of the fleet's robots
  FleetServerStatus counts_;
  double clock_ = 0;
  ros::Time last_time_;
  double state_at_ = 0;

  std::map<std::string, ros::Publisher> routes_;  ///< by ROS name
  ros::Publisher all_routes_;
  ros::Publisher state_;
  std::vector<ros::ServiceServer> services_;
  ros::WallTimer timer_;
  ros::WallTimer pulse_;
  std::shared_ptr<StopFlag> stop_;
  std::shared_ptr<StopFlag> hurry_;  ///< of the replan that runs
  std::thread replanner_;
  bool replans_ = false;
  std::unique_ptr<Server> server_;
  std::unique_ptr<MoveAction> move_;
};

}  // namespace split_mapf
