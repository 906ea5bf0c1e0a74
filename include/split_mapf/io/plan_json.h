#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "split_mapf/core/grid.h"
#include "split_mapf/core/layout.h"
#include "split_mapf/core/plan_report.h"
#include "split_mapf/io/cell_paths.h"

namespace split_mapf {

/// Writes a report as one JSON object, a field a line and a robot's path a line, with every field
/// that the public interface lists. Without a plan `paths` is [] and makespan, sum_of_costs, gap
/// and first_plan_s are null. The lower bounds are null when a robot is cut off from its goal, gap
/// when the proved bound is 0 and the cost is not, any number when it is not finite. `layout` is
/// null when there was no space split. The JSON is ASCII; a message that is not UTF-8 has its bad
/// bytes replaced. The layout's owners come as [region, cells] runs over the whole grid, row by
/// row, region -1 where it is blocked.
/// @pre the plan's vertices are those of `grid`. The caller checks the stream. Cost: O(entries).
void writePlanJson(std::ostream& out, const Grid& grid, const PlanReport& report);
/// The same into a file. @throws InputError when it cannot be written in full.
void writePlanJson(const std::string& path, const Grid& grid, const PlanReport& report);

/// Reads the `paths` of such a file; the other fields are left alone. What the paths claim is not
/// judged: an empty path, a jump or a cell outside the map is validate()'s to report.
/// @throws InputError "path:line: ..." for malformed JSON; "path: ..." for a missing or second
/// `paths` and for a coordinate that is no 32-bit integer, naming robot and step.
CellPaths readPlanJson(const std::string& path);
/// Reads the `layout` of such a file; nothing when it is null. @throws InputError "path: ..." for a
/// layout that is none of `grid`: too few or too many cells, an owner of a blocked cell, a state
/// off the free cells, an ownership that is not there.
std::optional<Layout> readPlanLayout(const std::string& path, const Grid& grid);

}  // namespace split_mapf
