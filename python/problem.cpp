#include "problem.h"

#include <cstddef>
#include <limits>
#include <utility>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/io/map_file.h"

namespace split_mapf::python {
namespace {

namespace py = pybind11;

/// The cell that each fault is about. Of a robot's faults that of the start comes first.
std::vector<Cell> faultyCells(const Problem& problem, const Grid& grid,
                              const std::vector<InstanceFault>& faults) {
  std::vector<Cell> cells;
  std::uint32_t last = std::numeric_limits<std::uint32_t>::max();
  for (const InstanceFault& fault : faults) {
    const Cell start = problem.starts[fault.robot];
    const bool is_first = fault.robot != last;
    const bool start_is_placed_wrong =
        fault.kind != FaultKind::kDuplicateGoal && is_first && !grid.isFree(start);
    const bool at_start = fault.kind == FaultKind::kDuplicateStart || start_is_placed_wrong;
    cells.push_back(at_start ? start : problem.goals[fault.robot]);
    last = fault.robot;
  }
  return cells;
}

void takeCells(Problem& problem, const BlockedArray& blocked) {
  constexpr py::ssize_t kMost = std::numeric_limits<std::uint32_t>::max();
  if (blocked.ndim() != 2 || blocked.shape(0) > kMost || blocked.shape(1) > kMost) {
    throw InputError("map: an array of " +
                     counted(static_cast<std::uint64_t>(blocked.ndim()), "dimension") +
                     " was given, two are expected: rows from the top, and columns");
  }
  problem.height = static_cast<std::uint32_t>(blocked.shape(0));
  problem.width = static_cast<std::uint32_t>(blocked.shape(1));
  const bool* const first = blocked.data();
  problem.free_cells.resize(static_cast<std::size_t>(blocked.size()));
  for (std::size_t i = 0; i < problem.free_cells.size(); ++i) problem.free_cells[i] = !first[i];
}

}  // namespace

Problem problemOf(const py::object& map, const OccupancyRule& rule, const CellArray& starts,
                  const CellArray& goals) {
  Problem problem;
  problem.rule = rule;
  requireRule(rule);
  if (py::isinstance<py::bytes>(map)) {
    problem.map_file = map.cast<std::string>();
    if (problem.map_file.empty()) throw InputError("map: the name of the file is empty");
  } else {
    takeCells(problem, map.cast<BlockedArray>());
  }
  problem.starts = cellsOf(starts);
  problem.goals = cellsOf(goals);
  return problem;
}

std::vector<Cell> cellsOf(const CellArray& cells) {
  if (cells.ndim() != 2 || cells.shape(1) != 2) {
    throw InputError("cells are expected as rows of two whole numbers, [x, y]");
  }
  std::vector<Cell> result(static_cast<std::size_t>(cells.shape(0)));
  const std::int32_t* next = cells.data();
  for (Cell& cell : result) {
    cell = {next[0], next[1]};
    next += 2;
  }
  return result;
}

CellPaths pathsOf(const std::vector<CellArray>& paths) {
  CellPaths result;
  result.reserve(paths.size());
  for (const CellArray& path : paths) result.push_back(cellsOf(path));
  return result;
}

CellArray arrayOf(const std::vector<Cell>& cells) {
  CellArray array({static_cast<py::ssize_t>(cells.size()), py::ssize_t{2}});
  std::int32_t* next = array.mutable_data();
  for (const Cell cell : cells) {
    *next++ = cell.x;
    *next++ = cell.y;
  }
  return array;
}

std::shared_ptr<const Grid> gridOf(const Problem& problem, const Deadline& deadline) {
  if (!problem.map_file.empty()) return readMap(problem.map_file, problem.rule);
  return std::make_shared<const Grid>(problem.width, problem.height, problem.free_cells, deadline);
}

Instance instanceOf(const Problem& problem, const std::shared_ptr<const Grid>& grid) {
  try {
    return Instance(grid, problem.starts, problem.goals);
  } catch (const InstanceError& error) {
    throw FaultyCells(error, faultyCells(problem, *grid, error.faults()));
  }
}

}  // namespace split_mapf::python
