#include "ros/convert/plan_check.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "split_mapf/core/error.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/roadmap/courses.h"
#include "split_mapf/ros/outcome.h"
#include "split_mapf/ros/plan_messages.h"

namespace split_mapf {
namespace {

// An answer that somebody may read.
constexpr std::size_t kMostViolations = 1000;

using CellPaths = std::vector<std::vector<Cell>>;

/// Writes violations the way ROS users see robots and cells.
class ViolationWriter {
 public:
  ViolationWriter(const MultiRobotPlan& plan, const PlanningGrid& grid, const CellPaths& paths)
      : plan_(plan), grid_(grid), paths_(paths) {}

  std::string describe(const Violation& violation) const {
    const std::string who = nameOf(violation.robot);
    const std::string at_step = "step " + std::to_string(violation.step);
    const std::string here = at(violation.robot, violation.step);
    switch (violation.kind) {
      case ViolationKind::kEmptyPath:
        return who + " has an empty path";
      case ViolationKind::kOutsideGrid:
        return who + " is in " + here + " at " + at_step + ", which is no free cell of the map";
      case ViolationKind::kJump:
        return who + " jumps from " + at(violation.robot, violation.step - 1) + " to " + here +
               " at " + at_step + "; a move goes to one of four neighbours";
      case ViolationKind::kVertexConflict:
        return who + " and " + nameOf(violation.other) + " are both in " + here + " at " + at_step;
      case ViolationKind::kSwapConflict:
        return who + " and " + nameOf(violation.other) + " swap cells at " + at_step + ": " +
               at(violation.robot, violation.step - 1) + " and " + here;
      default:
        return violation.message;
    }
  }

 private:
  std::string nameOf(std::uint32_t robot) const {
    return "robot " + quote(plan_.paths[robot].robot_id);
  }
  std::string at(std::uint32_t robot, std::uint32_t step) const {
    const std::vector<Cell>& path = paths_[robot];
    if (path.empty()) return "no cell";
    const Cell cell = path[std::min<std::size_t>(step, path.size() - 1)];
    return "cell " + grid_.geometry.describeWithMetres(cell);
  }

  const MultiRobotPlan& plan_;
  const PlanningGrid& grid_;
  const CellPaths& paths_;
};

void checkGrid(const MultiRobotPlan& plan, const MapGeometry& map,
               std::vector<std::string>& found) {
  const nav_msgs::MapMetaData& of_map = map.info();
  if (plan.grid.width != of_map.width || plan.grid.height != of_map.height ||
      plan.grid.resolution != of_map.resolution) {
    found.push_back("the plan's grid of " + std::to_string(plan.grid.width) + "x" +
                    std::to_string(plan.grid.height) + " cells of " +
                    numeral(plan.grid.resolution) + " m is not the map's of " +
                    std::to_string(of_map.width) + "x" + std::to_string(of_map.height) +
                    " cells of " + numeral(of_map.resolution) + " m");
    return;
  }
  try {
    const MapGeometry geometry(plan.grid, plan.header.frame_id);
    const geometry_msgs::Point ours = map.centreOf({0, 0});
    const geometry_msgs::Point theirs = geometry.centreOf({0, 0});
    if (geometry.frame() != map.frame()) {
      found.push_back("the plan's frame " + quote(geometry.frame()) + " is not the map's frame " +
                      quote(map.frame()));
    } else if (std::hypot(ours.x - theirs.x, ours.y - theirs.y) > 0.01 * of_map.resolution ||
               std::abs(std::remainder(geometry.yaw() - map.yaw(), 2 * M_PI)) > 1e-4) {
      found.emplace_back("the plan's grid has another origin than the map");
    }
  } catch (const GoalError& error) {
    found.push_back(std::string("the plan's grid is none; ") + error.what());
  }
}

void checkRobotIds(const MultiRobotPlan& plan, std::vector<std::string>& found) {
  std::set<std::string> ids;
  for (const RobotPath& path : plan.paths) {
    if (!ids.insert(path.robot_id).second) {
      found.push_back("robot " + quote(path.robot_id) + " has more than one path");
    }
  }
}

void checkCosts(const MultiRobotPlan& plan, std::vector<std::string>& found) {
  Plan cells;
  for (const RobotPath& path : plan.paths) {
    if (path.cells.empty()) return;
    cells.paths.emplace_back(path.cells.begin(), path.cells.end());
  }
  if (makespanOf(cells) != plan.makespan) {
    found.push_back("the plan claims makespan " + std::to_string(plan.makespan) +
                    ", its paths have " + std::to_string(makespanOf(cells)));
  }
  if (sumOfCostsOf(cells) != plan.sum_of_costs) {
    found.push_back("the plan claims sum of costs " + std::to_string(plan.sum_of_costs) +
                    ", its paths have " + std::to_string(sumOfCostsOf(cells)));
  }
}

/// Violations of the paths as such. Starts and goals are not known here, so an instance of one
/// robot stands in: validate() checks surplus paths for all but start and goal.
void checkPaths(const MultiRobotPlan& plan, const PlanningGrid& grid,
                std::vector<std::string>& found) {
  CellPaths paths;
  for (const RobotPath& path : plan.paths) {
    paths.emplace_back();
    for (const std::uint32_t index : path.cells) {
      paths.back().push_back(grid.geometry.cellOf(index));
    }
  }
  if (grid.grid->size() == 0) {
    if (!paths.empty()) found.emplace_back("the map has no free cell");
    return;
  }
  const Instance stand_in = Instance::fromVertices(grid.grid, {0}, {0});
  const ViolationWriter writer(plan, grid, paths);
  for (const Violation& violation : validate(stand_in, paths)) {
    if (violation.kind == ViolationKind::kRobotCount ||
        violation.kind == ViolationKind::kWrongStart ||
        violation.kind == ViolationKind::kWrongGoal) {
      continue;
    }
    found.push_back(writer.describe(violation));
  }
}

/// At most so many, and how many more there are.
void shorten(std::vector<std::string>& found) {
  if (found.size() <= kMostViolations) return;
  const std::size_t more = found.size() - kMostViolations;
  found.resize(kMostViolations);
  found.push_back("and " + counted(more, "more violation"));
}

/// Whether the robots' ways can be put together from what the plan says.
void checkShapes(const MultiRobotPlan& plan, std::vector<std::string>& found) {
  const std::uint64_t cells = std::uint64_t{plan.grid.width} * plan.grid.height;
  for (const RobotPath& path : plan.paths) {
    const std::string who = "robot " + quote(path.robot_id) + " ";
    const std::string fault = faultOfLegs(plan, path);
    if (!fault.empty()) found.push_back(who + fault);
    if (path.cells.empty()) found.push_back(who + "has an empty path");
    for (const std::uint32_t cell : path.cells) {
      if (cell < cells) continue;
      found.push_back(who + "is in cell " + std::to_string(cell) + " of a map of " +
                      std::to_string(cells) + " cells");
      break;
    }
    if (!(path.radius >= 0 && path.radius <= plan.robot_radius)) {
      found.push_back(who + "has radius " + numeral(path.radius) + " m in a plan for at most " +
                      numeral(plan.robot_radius) + " m");
    }
  }
  const std::string too_long = faultOfWays(plan);
  if (!too_long.empty()) found.push_back(too_long);
  if (!(plan.clearance >= 0)) {
    found.push_back("the plan's clearance is " + numeral(plan.clearance) + " m");
  }
}

bool isSamePlace(const geometry_msgs::Point& a, const geometry_msgs::Point& b) {
  // What is as near to its vertex as 1e-6 m needs no leg.
  constexpr double kSamePlaceM = 2e-6;
  return std::hypot(a.x - b.x, a.y - b.y) <= kSamePlaceM;
}

/// Without a leg a robot has to stand at the centre of its cell.
void compareEnds(const RobotPath& path, const std::vector<geometry_msgs::Point>& way,
                 std::vector<std::string>& found) {
  const auto compare = [&](const char* end, const geometry_msgs::Point& claimed,
                           const geometry_msgs::Point& cell) {
    if (isSamePlace(claimed, cell)) return;
    const auto text = [](const geometry_msgs::Point& p) {
      return "(" + numeral(p.x) + ", " + numeral(p.y) + ")";
    };
    found.push_back("robot " + quote(path.robot_id) + " has its " + end + " at " + text(claimed) +
                    ", but no leg between that and its cell's centre, " + text(cell));
  };
  compare("start", path.start.position, way.front());
  compare("goal", path.goal.position, way.back());
}

/// The poses of a filled path have to be the way that the cells and legs say.
void comparePoses(const RobotPath& path, const std::vector<geometry_msgs::Point>& way,
                  std::vector<std::string>& found) {
  if (path.path.poses.empty()) return;
  const std::string who = "robot " + quote(path.robot_id);
  if (path.path.poses.size() != way.size()) {
    found.push_back(who + " has " + counted(path.path.poses.size(), "pose") + " for " +
                    counted(way.size() - 1, "step"));
    return;
  }
  for (std::size_t step = 0; step < way.size(); ++step) {
    const geometry_msgs::Point& p = path.path.poses[step].pose.position;
    if (isSamePlace(p, way[step])) continue;
    found.push_back(who + " has another pose at step " + std::to_string(step) +
                    " than its cells and legs say");
    return;
  }
}

void checkLongestStep(const MultiRobotPlan& plan, std::size_t robot, const Course& course,
                      std::vector<std::string>& found) {
  for (std::size_t step = 1; step < course.size(); ++step) {
    const double length =
        std::hypot(course[step].x - course[step - 1].x, course[step].y - course[step - 1].y);
    if (length <= plan.longest_step + 1e-6) continue;
    found.push_back("robot " + quote(plan.paths[robot].robot_id) + " covers " + inMetres(length) +
                    " in step " + std::to_string(step) + ", more than longest_step, " +
                    inMetres(plan.longest_step));
    return;
  }
}

}  // namespace

std::vector<std::string> findDiscViolations(const MultiRobotPlan& plan, const MapGeometry& geometry,
                                            const ObstacleRaster& raster,
                                            const Deadline& deadline) {
  std::vector<std::string> found;
  if (plan.paths.empty()) found.emplace_back("the plan has no paths");
  checkGrid(plan, geometry, found);
  checkRobotIds(plan, found);
  checkCosts(plan, found);
  const std::size_t of_claims = found.size();
  checkShapes(plan, found);
  if (found.size() > of_claims || plan.paths.empty()) {
    shorten(found);
    return found;
  }
  const MapFrame frame = frameOf(geometry);
  Discs discs;
  discs.clearance_m = plan.clearance;
  std::vector<Course> courses;
  std::vector<std::string> names;
  const RobotWays ways(plan, geometry);
  for (std::size_t i = 0; i < plan.paths.size(); ++i) {
    deadline.require();
    const std::vector<geometry_msgs::Point> way = ways.of(i);
    compareEnds(plan.paths[i], way, found);
    comparePoses(plan.paths[i], way, found);
    Course& course = courses.emplace_back();
    for (const geometry_msgs::Point& p : way) course.push_back(toRaster(frame, {p.x, p.y}));
    checkLongestStep(plan, i, course, found);
    discs.radius_m.push_back(plan.paths[i].radius);
    names.push_back("robot " + quote(plan.paths[i].robot_id));
  }
  const DiscCheck check = checkDiscs(raster, discs, courses, kMostViolations + 1, deadline);
  for (const DiscViolation& violation : check.violations) {
    found.push_back(explain(violation, names, frame));
  }
  shorten(found);
  return found;
}

std::vector<std::string> findViolations(const MultiRobotPlan& plan, const PlanningGrid& grid) {
  std::vector<std::string> found;
  if (plan.paths.empty()) found.emplace_back("the plan has no paths");
  checkGrid(plan, grid.geometry, found);
  checkRobotIds(plan, found);
  checkCosts(plan, found);
  checkPaths(plan, grid, found);
  shorten(found);
  return found;
}

}  // namespace split_mapf
