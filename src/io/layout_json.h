#pragma once

#include <string>

#include "split_mapf/core/grid.h"
#include "split_mapf/core/layout.h"

namespace split_mapf {

/// A layout as JSON text: `partition`; `ownerships`, each a list of [region, cells] runs over the
/// whole grid, row by row from the top, region -1 for blocked cells; `buffers`, the cells that
/// change owner; `phases`, each with the number of its `ownership` and the `states`, a cell a
/// robot, in which it ends. @param indent  of the lines behind the first. Cost: O(cells).
std::string layoutJson(const Grid& grid, const Layout& layout, const std::string& indent);

}  // namespace split_mapf
