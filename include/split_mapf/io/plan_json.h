#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "split_mapf/core/grid.h"
#include "split_mapf/core/layout.h"
#include "split_mapf/core/plan_report.h"
#include "split_mapf/io/cell_paths.h"
#include "split_mapf/io/map_server.h"
#include "split_mapf/roadmap/map_frame.h"

namespace split_mapf {

/// How `paths` are written. Readers tell them apart by themselves.
enum class PathForm {
  kCells,    ///< [[x,y], ...], a cell a step
  kCompact,  ///< "x,y 4R2DWU": the first cell, then runs of moves; a twentieth of the bytes or so.
             ///< R and L: x, D and U: y, which grows downwards; W: a step of waiting
};
std::string toString(PathForm form);
/// "cells" or "compact". @throws OptionError for anything else.
PathForm parsePathForm(const std::string& text);

/// Writes a report as one JSON object, a field a line and a robot's path a line, with every field
/// that the public interface lists. Without a plan `paths` is [] and makespan, sum_of_costs, gap
/// and first_plan_s are null. The lower bounds are null when a robot is cut off from its goal, gap
/// when the proved bound is 0 and the cost is not, any number when it is not finite. `layout` is
/// null when there was no space split. The JSON is ASCII; a message that is not UTF-8 has its bad
/// bytes replaced. The layout's owners come as [region, cells] runs over the whole grid, row by
/// row, region -1 where it is blocked.
/// @pre the plan's vertices are those of `grid`. The caller checks the stream. Cost: O(entries).
/// @pre for kCompact, `grid` has moves between neighbouring cells only.
void writePlanJson(std::ostream& out, const Grid& grid, const PlanReport& report,
                   PathForm form = PathForm::kCells);
/// The same into a file. @throws InputError when it cannot be written in full.
void writePlanJson(const std::string& path, const Grid& grid, const PlanReport& report);

/// What a result says of robots that have size, besides; lengths in metres.
struct DiscResult {
  double resolution_m = 0;  ///< of the map
  MapOrigin origin;
  double robot_radius_m = 0;  ///< of the largest robot
  double clearance_m = 0;
  double longest_step_m = 0;                 ///< that a robot covers in one step at most
  double step_duration_sec = 0;              ///< 0: unknown
  std::uint32_t departure_steps = 0;         ///< of legs, before `paths` begin
  std::uint32_t arrival_steps = 0;           ///< of legs, when all `paths` have ended
  std::vector<std::string> ids;              ///< a robot
  std::vector<double> radius_m;              ///< a robot
  std::vector<double> least_clearance_m;     ///< a robot; empty without a plan
  std::vector<std::vector<MapPoint>> poses;  ///< a robot, in the map's frame; empty likewise
};

/// The same for robots that have size: in front of `paths`, which names cells of the map, also
/// `grid` (resolution, width, height, origin [x, y, yaw]), `robot_radius`, `clearance`,
/// `longest_step`, `step_duration` (null: unknown), `departure_steps`, `arrival_steps`, `robots`
/// (ids), `radii`, `least_clearance`; behind it `poses`, a point [x, y] a step, legs included.
/// @pre `grid` is the planning graph.
void writePlanJson(std::ostream& out, const Grid& grid, const PlanReport& report,
                   const DiscResult& discs);
void writePlanJson(const std::string& path, const Grid& grid, const PlanReport& report,
                   const DiscResult& discs);

/// What such a file claims of robots that have size.
struct DiscClaims {
  double robot_radius_m = 0;
  double clearance_m = 0;
  std::vector<double> radius_m;  ///< a robot; empty where the file has no `radii`
  std::vector<std::vector<MapPoint>> poses;
  CellPaths paths;  ///< on the planning graph
};
/// Reads it. What paths and poses claim is not judged. @throws InputError as readPlanJson(), and
/// "path: ..." for a missing `poses`, a point that is no pair of numbers, a radius or clearance
/// that is no number of 0 or more, and another number of `radii` than of `poses`.
DiscClaims readDiscPlanJson(const std::string& path);

/// Reads the `paths` of such a file, of either form; the other fields are left alone. What the
/// paths claim is not judged: an empty path, a jump or a cell outside the map is validate()'s to
/// report.
/// @throws InputError "path:line: ..." for malformed JSON; "path: ..." for a missing or second
/// `paths`, for a coordinate that is no 32-bit integer, naming robot and step, for a compact path
/// that is none, naming the robot, and for a plan of robots that have size.
CellPaths readPlanJson(const std::string& path);
/// Reads the `layout` of such a file; nothing when it is null. @throws InputError "path: ..." for a
/// layout that is none of `grid`: too few or too many cells, an owner of a blocked cell, a state
/// off the free cells, an ownership that is not there.
std::optional<Layout> readPlanLayout(const std::string& path, const Grid& grid);

}  // namespace split_mapf
