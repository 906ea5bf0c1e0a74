#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include "problem.h"
#include "split_mapf/core/grid.h"
#include "split_mapf/core/plan_report.h"

namespace split_mapf::python {

/// A report as Python sees it, and the grid that its vertices lie on (null where time was up before
/// the map was read: then there is no plan).
class PlanResult {
 public:
  PlanResult(std::shared_ptr<const Grid> grid, PlanReport report)
      : grid_(std::move(grid)), report_(std::move(report)) {}

  const PlanReport& report() const { return report_; }
  bool isSolved() const { return report_.plan.has_value(); }
  /// A list of one array [step, (x, y)] a robot; empty without a plan.
  pybind11::list paths() const;
  /// Of all robots at all steps of the makespan: an array [step, robot, (x, y)].
  CellArray positions() const;
  pybind11::object gap() const;
  /// As the command writes it.
  std::string json() const;
  std::string describe() const;

 private:
  std::shared_ptr<const Grid> grid_;
  PlanReport report_;
};

/// Makes the class known to Python.
void definePlanResult(pybind11::module& module);

}  // namespace split_mapf::python
