#pragma once

#include <string>

#include "split_mapf/core/problem.h"

namespace split_mapf {

/// A problem as bytes, to be kept or sent to another process or machine: the grid or planning
/// graph, starts and goals. The same on every machine; a bit a cell and a few bytes a robot.
/// @pre every start and goal is a vertex of the grid.
std::string toBytes(const Problem& problem);

/// Reads what toBytes() wrote. The problem is solved as the one that was written: vertices have the
/// same numbers, so solvers give the same plans. Never trusts the bytes: memory stays in
/// proportion to their number. @throws InputError naming the byte and what was expected there.
Problem problemFromBytes(const std::string& bytes);

}  // namespace split_mapf
