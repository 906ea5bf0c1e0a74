#pragma once

#include <memory>
#include <string>
#include <vector>

#include "split_mapf/core/grid.h"
#include "split_mapf/core/instance.h"

namespace split_mapf::test {

/// A grid drawn in characters, one string a row from the top: '.' is free, '#' is blocked.
/// @throws std::invalid_argument for any other character or rows of different lengths.
std::shared_ptr<const Grid> gridFromAscii(const std::vector<std::string>& rows);

/// An instance drawn in two pictures: robot 0 starts at 'a' and ends at 'a', robot 1 'b', and so
/// on; '.' is free, '#' is blocked.
/// @throws std::invalid_argument when the pictures differ in walls or letters.
Instance instanceFromAscii(const std::vector<std::string>& starts,
                           const std::vector<std::string>& goals);

/// A corridor of one cell's width that winds through a square of `side` cells: about side^2/2 cells
/// from its first to its last vertex. @pre side is even
std::shared_ptr<const Grid> serpentineGrid(std::uint32_t side);

}  // namespace split_mapf::test
