#include "ros/convert/disc_goal.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ros/convert/task_reader.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/ros/orientation.h"
#include "split_mapf/ros/outcome.h"

namespace split_mapf {
namespace {

// [m] More is a mistake of units, and none of the map's business.
constexpr double kMostRadiusM = 1e6;

Outcome codeOf(AttachmentFaultKind kind) {
  switch (kind) {
    case AttachmentFaultKind::kOutsideMap:
      return Outcome::kOutsideMap;
    case AttachmentFaultKind::kTooNearObstacle:
      return Outcome::kBlockedCell;
    case AttachmentFaultKind::kNoVertex:
    case AttachmentFaultKind::kOtherPiece:
      return Outcome::kUnreachableGoal;
    case AttachmentFaultKind::kDiscsOverlap:
    case AttachmentFaultKind::kTaken:
    case AttachmentFaultKind::kCrowd:
      break;
  }
  return Outcome::kUnplaceable;
}

/// Reads the robots' poses and radii.
class DiscReader {
 public:
  DiscReader(const std::vector<RobotTask>& tasks, const MapGeometry& geometry,
             const PoseTransform& transform)
      : tasks_(tasks),
        frame_(frameOf(geometry)),
        reader_(tasks, geometry.frame(), transform),
        starts_(tasks.size()),
        goals_(tasks.size()) {}

  TaskReader& reader() { return reader_; }
  std::vector<geometry_msgs::Pose> takeStarts() { return std::move(starts_); }
  std::vector<geometry_msgs::Pose> takeGoals() { return std::move(goals_); }

  /// @throws GoalError with every robot at fault.
  std::vector<RobotPoses> read() {
    std::vector<RobotPoses> robots(tasks_.size());
    for (std::size_t i = 0; i < tasks_.size(); ++i) {
      robots[i].start = readPose(i, "start", tasks_[i].start, starts_[i]);
      robots[i].goal = readPose(i, "goal", tasks_[i].goal, goals_[i]);
      const double radius = tasks_[i].radius;
      if (!(radius >= 0 && radius <= kMostRadiusM)) {
        reader_.report(i, Outcome::kInvalidOption,
                       "its radius is " + numeral(radius) + "; a number from 0 (the option " +
                           "robot_radius) to " + numeral(kMostRadiusM) + " m is needed");
      }
      if (radius > 0) robots[i].radius_m = radius;
    }
    reader_.requireNoFaults();
    return robots;
  }

 private:
  MapPoint readPose(std::size_t robot, const char* role, const geometry_msgs::PoseStamped& stamped,
                    geometry_msgs::Pose& pose) {
    const std::optional<geometry_msgs::Point> at = reader_.locate(robot, role, stamped);
    if (!at) return {};
    pose.position = *at;
    if (const std::optional<double> heading = reader_.headingOf(stamped, *at)) {
      pose.orientation = quaternionOf(*heading);
    }
    return toRaster(frame_, {at->x, at->y});
  }

  const std::vector<RobotTask>& tasks_;
  const MapFrame frame_;
  TaskReader reader_;
  std::vector<geometry_msgs::Pose> starts_;
  std::vector<geometry_msgs::Pose> goals_;
};

DiscProblem attach(DiscTask task, TaskReader& reader, const Deadline& deadline) {
  try {
    return DiscProblem(std::move(task), deadline);
  } catch (const AttachmentError& error) {
    for (std::size_t i = 0; i < error.faults().size(); ++i) {
      const AttachmentFault& fault = error.faults()[i];
      reader.reportSentence(fault.robot, codeOf(fault.kind), error.messages()[i]);
    }
  }
  reader.requireNoFaults();
  throw std::logic_error("an attachment failed without faults");
}

}  // namespace

bool asksForRoadmap(const GoalOptions& options, const std::vector<RobotTask>& tasks,
                    double resolution_m) {
  if (std::any_of(tasks.begin(), tasks.end(),
                  [](const RobotTask& task) { return task.radius != 0; })) {
    return true;
  }
  return asksForRoadmap(options.roadmap, resolution_m);
}

void requireNoGraphOptions(const PlanOptions& asked) {
  const bool passages = asked.passages != PlanOptions::PASSAGES_DEFAULT;
  if (!passages && asked.snap_distance == 0) return;
  throw OptionError(std::string(passages ? "passages" : "snap_distance") +
                    " needs robots that have size: robot_radius, RobotTask.radius or cell_size");
}

PlacedDiscs placeDiscs(const std::vector<RobotTask>& tasks, const nav_msgs::OccupancyGrid& map,
                       const GoalOptions& options, const PoseTransform& transform,
                       const Deadline& deadline, const char*& doing) {
  MapGeometry geometry(map.info, map.header.frame_id);
  ObstacleRaster raster = makeRaster(map, options.occupancy, options.ignore_specks, deadline);
  doing = "while the robots were being placed";
  DiscReader discs(tasks, geometry, transform);
  DiscTask task;
  task.robots = discs.read();
  task.raster = std::make_shared<const ObstacleRaster>(std::move(raster));
  task.frame = frameOf(geometry);
  task.roadmap = options.roadmap;
  task.snap_distance_m = options.snap_distance_m;
  const std::vector<std::string> ids = discs.reader().ids();
  for (const std::string& id : ids) task.names.push_back("robot " + quote(id));
  doing = "while the planning graph was being built";
  auto placement = std::make_shared<DiscPlacement>(DiscPlacement{
      attach(std::move(task), discs.reader(), deadline), discs.takeStarts(), discs.takeGoals()});
  const std::shared_ptr<const Grid> grid = placement->problem.instance().sharedGrid();
  return {ids, PlanningGrid{grid, std::move(geometry), std::move(placement)}};
}

std::uint32_t stepsOf(const DiscProblem& problem, const Plan& plan) {
  return makespanOf(plan) + problem.attachment().departure.steps +
         problem.attachment().arrival.steps;
}

void addDiscs(const PlanningGrid& grid, const Plan& plan, MultiRobotPlan& message,
              const Deadline& deadline) {
  const DiscPlacement& discs = *grid.discs;
  const DiscProblem& problem = discs.problem;
  const DiscCourses ways = problem.coursesOf(plan, deadline);
  const Legs& away = problem.attachment().departure;
  const Legs& home = problem.attachment().arrival;
  message.robot_radius = problem.roadmap().robot_radius_m;
  message.clearance = problem.roadmap().clearance_m;
  message.longest_step = problem.longestStep();
  message.departure_steps = away.steps;
  message.arrival_steps = home.steps;
  for (std::size_t i = 0; i < message.paths.size(); ++i) {
    RobotPath& path = message.paths[i];
    path.radius = problem.discs().radius_m[i];
    path.start = discs.starts[i];
    path.goal = discs.goals[i];
    path.departure_steps = away.steps == 0 ? 0 : away.waves[i] + 1;
    path.arrival_steps = home.steps == 0 ? 0 : home.waves[i] + 1;
    path.least_clearance = ways.least_clearance_m[i];
  }
}

visualization_msgs::MarkerArray roadmapMarkers(const PlanningGrid& grid, const ros::Time& stamp) {
  using visualization_msgs::Marker;
  visualization_msgs::MarkerArray array;
  for (const bool edges : {true, false}) {
    Marker marker;
    marker.header.frame_id = grid.geometry.frame();
    marker.header.stamp = stamp;
    marker.ns = edges ? "edges" : "vertices";
    marker.type = edges ? Marker::LINE_LIST : Marker::POINTS;
    marker.pose.orientation.w = 1;
    marker.color.r = 0.2F;
    marker.color.g = 0.45F;
    marker.color.b = 0.8F;
    marker.color.a = edges ? 0.5F : 0.9F;
    // A plan without a planning graph takes the last one's away.
    if (!grid.discs) marker.action = Marker::DELETE;
    array.markers.push_back(marker);
  }
  if (!grid.discs) return array;
  const Roadmap& roadmap = grid.discs->problem.roadmap();
  const double spacing = roadmap.spacing_cells * roadmap.resolution_m;
  array.markers[0].scale.x = spacing / 24;
  array.markers[1].scale.x = array.markers[1].scale.y = spacing / 8;
  const auto point_of = [&](Vertex v) { return grid.geometry.centreOf(grid.grid->cellOf(v)); };
  for (const auto& [a, b] : roadmap.edges) {
    array.markers[0].points.push_back(point_of(a));
    array.markers[0].points.push_back(point_of(b));
  }
  for (Vertex v = 0; v < grid.grid->size(); ++v) array.markers[1].points.push_back(point_of(v));
  // rviz refuses empty lists.
  if (roadmap.edges.empty()) array.markers[0].action = Marker::DELETE;
  return array;
}

}  // namespace split_mapf
