#include "plan_result.h"

#include <pybind11/stl.h>

#include <cstdint>
#include <sstream>
#include <vector>

#include "split_mapf/core/wording.h"
#include "split_mapf/io/plan_json.h"

namespace split_mapf::python {
namespace {

namespace py = pybind11;

template <typename T>
py::object valueIf(bool meaningful, T value) {
  return meaningful ? py::cast(value) : py::none();
}

/// Lower bounds mean nothing where a robot is cut off, or before distances are known.
bool hasBounds(const PlanReport& report) {
  return report.plan || (!report.cut_off_robot && report.makespan_lower_bound > 0);
}

py::list traceOf(const PlanResult& result) {
  py::list rows;
  for (const TraceRow& row : result.report().trace) {
    rows.append(
        py::make_tuple(row.seconds, row.makespan, row.sum_of_costs, row.proved_lower_bound));
  }
  return rows;
}

py::dict stagesOf(const PlanResult& result) {
  py::dict stages;
  for (const auto& [name, seconds] : result.report().stages) stages[py::str(name)] = seconds;
  return stages;
}

py::list subproblemsOf(const PlanResult& result) {
  py::list rows;
  for (const SubproblemReport& piece : result.report().subproblems) {
    py::dict row;
    row["phase"] = piece.phase;
    row["region"] = piece.region;
    row["agents"] = piece.agents;
    row["horizon"] = piece.horizon;
    row["solver"] = piece.solver;
    row["status"] = piece.status;
    row["seconds"] = piece.seconds;
    rows.append(row);
  }
  return rows;
}

template <typename Value>
auto field(Value PlanReport::*member) {
  return [member](const PlanResult& result) { return result.report().*member; };
}

/// A cost; None without a plan.
template <typename Value>
auto cost(Value PlanReport::*member) {
  return [member](const PlanResult& result) {
    return valueIf(result.isSolved(), result.report().*member);
  };
}

template <typename Value>
auto bound(Value PlanReport::*member) {
  return [member](const PlanResult& result) {
    return valueIf(hasBounds(result.report()), result.report().*member);
  };
}

}  // namespace

py::list PlanResult::paths() const {
  py::list paths;
  if (!report_.plan) return paths;
  for (const Path& path : report_.plan->paths) {
    std::vector<Cell> cells;
    cells.reserve(path.size());
    for (const Vertex v : path) cells.push_back(grid_->cellOf(v));
    paths.append(arrayOf(cells));
  }
  return paths;
}

CellArray PlanResult::positions() const {
  const std::size_t robots = report_.plan ? report_.plan->paths.size() : 0;
  const std::size_t steps = report_.plan ? std::size_t{report_.makespan} + 1 : 0;
  CellArray array(
      {static_cast<py::ssize_t>(steps), static_cast<py::ssize_t>(robots), py::ssize_t{2}});
  std::int32_t* next = array.mutable_data();
  for (std::uint32_t step = 0; step < steps; ++step) {
    for (const Path& path : report_.plan->paths) {
      const Cell cell = grid_->cellOf(positionAt(path, step));
      *next++ = cell.x;
      *next++ = cell.y;
    }
  }
  return array;
}

py::object PlanResult::gap() const {
  if (!report_.plan) return py::none();
  const auto cost = static_cast<double>(costOf(*report_.plan, report_.objective));
  if (report_.proved_lower_bound <= 0) return valueIf(cost == 0, 0.0);
  return py::cast(cost / report_.proved_lower_bound - 1);
}

std::string PlanResult::json() const {
  std::ostringstream text;
  writePlanJson(text, grid_ ? *grid_ : Grid(1, 1, {true}), report_);
  return text.str();
}

std::string PlanResult::describe() const {
  std::string text = "<" + toString(report_.termination) + ": ";
  if (report_.plan) {
    text += counted(report_.robots, "robot") + ", makespan " + std::to_string(report_.makespan) +
            ", sum of costs " + std::to_string(report_.sum_of_costs) + ">";
  } else {
    text += report_.message + ">";
  }
  return text;
}

void definePlanResult(py::module& module) {
  py::class_<PlanResult>(module, "Result",
                         "What became of a call: true where a valid plan is there. Its fields are "
                         "those of the command's JSON.")
      .def_property_readonly(
          "status", [](const PlanResult& r) { return toString(r.report().termination); },
          "solved, unsolvable, timeout, cancelled, no_plan_found or memory_limit")
      .def_property_readonly("message", field(&PlanReport::message), "one sentence")
      .def_property_readonly("solver", field(&PlanReport::solver), "as it was asked")
      .def_property_readonly("split", field(&PlanReport::split), "as it was asked")
      .def_property_readonly(
          "objective", [](const PlanResult& r) { return toString(r.report().objective); },
          "makespan or sum_of_costs")
      .def_property_readonly("seed", field(&PlanReport::seed))
      .def_property_readonly("threads", field(&PlanReport::threads), "that were used")
      .def_property_readonly("agents", field(&PlanReport::robots), "number of robots")
      .def_property_readonly("makespan", cost(&PlanReport::makespan),
                             "[steps] greatest cost of a robot; None without a plan")
      .def_property_readonly("sum_of_costs", cost(&PlanReport::sum_of_costs),
                             "[steps]; None without a plan")
      .def_property_readonly("makespan_lower_bound", bound(&PlanReport::makespan_lower_bound),
                             "[steps] from shortest paths; None where they are not known")
      .def_property_readonly("sum_of_costs_lower_bound",
                             bound(&PlanReport::sum_of_costs_lower_bound),
                             "[steps] from shortest paths; None where they are not known")
      .def_property_readonly("proved_lower_bound", field(&PlanReport::proved_lower_bound),
                             "[steps] of the objective")
      .def_property_readonly("gap", &PlanResult::gap, "cost / proved_lower_bound - 1")
      .def_property_readonly("optimal", field(&PlanReport::optimal), "proved to cost least")
      .def_property_readonly("certified_by", field(&PlanReport::certified_by), "who proved it")
      .def_property_readonly("runtime_s", field(&PlanReport::runtime_sec), "reading excluded")
      .def_property_readonly("first_plan_s", cost(&PlanReport::first_plan_sec),
                             "to the first valid plan; None without one")
      .def_property_readonly("trace", &traceOf,
                             "(seconds, makespan, sum of costs, proved bound) an improvement")
      .def_property_readonly("stages", &stagesOf, "seconds a stage")
      .def_property_readonly("subproblems", &subproblemsOf, "a dict a piece")
      .def_property_readonly(
          "paths", &PlanResult::paths,
          "One array [step, (x, y)] a robot, from its start to its arrival; x is "
          "the column, y the row from the top. Made anew at each access.")
      .def("positions", &PlanResult::positions,
           "All robots at all steps: an array [step, robot, (x, y)]; who has arrived stays.")
      .def("json", &PlanResult::json, "The text that `split_mapf plan --output` writes.")
      .def("__bool__", &PlanResult::isSolved)
      .def("__repr__", &PlanResult::describe);
}

}  // namespace split_mapf::python
