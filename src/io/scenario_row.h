#pragma once

#include <optional>
#include <string>
#include <vector>

namespace split_mapf {

constexpr const char* kScenarioRowShape =
    "9 columns: bucket, map, width, height, start x, start y, goal x, goal y, length";

/// The columns of one row of a MovingAI scenario, in its order. `length` is empty where it is left
/// out.
struct ScenarioRow {
  std::string bucket, map, width, height, start_x, start_y, goal_x, goal_y, length;
};

/// Splits a row. Columns are parted by any number of tabs, or by blanks where there are not nine
/// with tabs. The name of the map may hold blanks, also where blanks part the columns: the others
/// are counted from the end then. Only the last column may be missing, and only where no two tabs
/// stand together, which could hide another missing one.
/// @return nothing for another number of columns.
std::optional<ScenarioRow> splitScenarioRow(const std::string& row);

/// Whether the row, which may be any line, has all nine columns, and whole numbers where they
/// belong.
bool isWholeScenarioRow(const std::string& row);

/// How many columns a refused row has.
std::size_t countColumns(const std::string& row);

}  // namespace split_mapf
