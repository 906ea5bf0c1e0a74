#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/io/cell_paths.h"
#include "split_mapf/io/occupancy.h"

namespace split_mapf::python {

/// Cells as Python has them: a row [x, y] each.
using CellArray = pybind11::array_t<std::int32_t, pybind11::array::c_style>;
/// Which cells of a map are blocked: [row from the top, column].
using BlockedArray = pybind11::array_t<bool, pybind11::array::c_style>;

/// What is asked of the package, copied out of Python's objects: threads read it without the
/// interpreter's lock.
struct Problem {
  std::string map_file;          ///< empty: the cells are given
  OccupancyRule rule;            ///< of a file
  std::uint32_t width = 0;       ///< of given cells
  std::uint32_t height = 0;      ///< likewise
  std::vector<bool> free_cells;  ///< likewise, row-major
  std::vector<Cell> starts;
  std::vector<Cell> goals;
};

/// @param map  bytes: the name of a file; else a BlockedArray. @throws InputError for other shapes
/// of arrays.
Problem problemOf(const pybind11::object& map, const OccupancyRule& rule, const CellArray& starts,
                  const CellArray& goals);
/// @throws InputError for an array of another shape.
std::vector<Cell> cellsOf(const CellArray& cells);
CellPaths pathsOf(const std::vector<CellArray>& paths);
CellArray arrayOf(const std::vector<Cell>& cells);

/// Reads or builds the map. @throws InputError as readMap() and Grid; Interrupted.
std::shared_ptr<const Grid> gridOf(const Problem& problem, const Deadline& deadline);

/// An instance that is ill-posed, with the cells that are at fault.
class FaultyCells : public InstanceError {
 public:
  FaultyCells(const InstanceError& error, std::vector<Cell> cells)
      : InstanceError(error), cells_(std::move(cells)) {}
  /// One a fault.
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  std::vector<Cell> cells_;
};

/// @throws FaultyCells, InputError as Instance.
Instance instanceOf(const Problem& problem, const std::shared_ptr<const Grid>& grid);

}  // namespace split_mapf::python
