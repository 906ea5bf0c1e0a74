// The module split_mapf._core: what python/split_mapf/planning.py makes the public functions of.
#include <pybind11/functional.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "call.h"
#include "errors.h"
#include "plan_result.h"
#include "problem.h"
#include "solver/available/available_solvers.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/io/map_file.h"
#include "split_mapf/io/movingai.h"
#include "split_mapf/parallel/executor.h"
#include "split_mapf/pipeline/planner.h"
#include "split_mapf/pipeline/refine_plan.h"
#include "split_mapf/solvability/solvability.h"

namespace split_mapf::python {
namespace {

namespace py = pybind11;

/// What Python calls with each better plan; None: nobody. It may return False: good enough.
using Callback = std::optional<py::function>;

std::unique_ptr<Executor> startExecutor(std::uint32_t threads) {
  if (threads == 0) threads = Executor::machineThreads();
  try {
    return std::make_unique<Executor>(threads);
  } catch (const std::system_error& error) {
    throw InputError("threads: " + counted(threads, "thread") +
                     " cannot be started: " + error.what());
  }
}

Call::Listener listenerOf(const Callback& callback, const std::shared_ptr<const Grid>& grid) {
  if (!callback) return nullptr;
  return [callback, &grid](const PlanReport& report) {
    const py::object answer = (*callback)(PlanResult(grid, report));
    return !py::isinstance<py::bool_>(answer) || answer.cast<bool>();
  };
}

/// The report of a call that ended before the planner began.
PlanReport endedBefore(const PlanRequest& request, const Problem& problem,
                       const Deadline& deadline) {
  PlanReport report = reportOf(request, static_cast<std::uint32_t>(problem.starts.size()));
  report.termination = deadline.stopRequested() ? Termination::kCancelled : Termination::kTimeout;
  report.message = "before the map was there";
  return report;
}

PlanResult plan(const Problem& problem, const PlanRequest& request, const Callback& callback) {
  const std::unique_ptr<Executor> executor = startExecutor(request.threads);
  const Planner planner(availableSolvers(), *executor);
  planner.requireValid(request);  // before files are read for nothing
  std::shared_ptr<const Grid> grid;
  std::optional<PlanReport> report;
  Call call(request.time_limit_sec, listenerOf(callback, grid));
  call.run([&] {
    try {
      grid = gridOf(problem, call.deadline());
    } catch (const Interrupted&) {
      report = endedBefore(request, problem, call.deadline());
      return;
    }
    PlanListener listener;
    if (callback) listener.better_plan = [&call](const PlanReport& better) { call.show(better); };
    report = planner.plan(instanceOf(problem, grid), request, call.deadline(), listener);
  });
  return PlanResult(grid, std::move(*report));
}

/// Paths as vertices of the grid. @throws InputError for one that leaves the free cells.
Plan planOf(const Grid& grid, const CellPaths& paths) {
  Plan plan;
  for (std::size_t robot = 0; robot < paths.size(); ++robot) {
    Path& path = plan.paths.emplace_back();
    for (std::size_t step = 0; step < paths[robot].size(); ++step) {
      const Cell cell = paths[robot][step];
      path.push_back(grid.vertexAt(cell));
      if (path.back() != kNoVertex) continue;
      throw InputError("robot " + std::to_string(robot) + " is in " + toString(cell) + " at step " +
                       std::to_string(step) + "; a free cell is needed");
    }
  }
  return plan;
}

PlanResult refine(const Problem& problem, const std::vector<CellArray>& paths,
                  const PlanRequest& request, const Callback& callback) {
  const std::unique_ptr<Executor> executor = startExecutor(request.threads);
  Planner(availableSolvers(), *executor).requireValid(request);
  const CellPaths given = pathsOf(paths);
  std::shared_ptr<const Grid> grid;
  std::optional<PlanReport> report;
  Call call(request.refine_sec, listenerOf(callback, grid));
  call.run([&] {
    PlanListener listener;
    if (callback) listener.better_plan = [&call](const PlanReport& better) { call.show(better); };
    try {
      grid = gridOf(problem, call.deadline());
      report = refinePlan(instanceOf(problem, grid), planOf(*grid, given), request,
                          availableSolvers(), *executor, call.deadline(), listener);
    } catch (const Interrupted&) {
      report = endedBefore(request, problem, call.deadline());
    }
  });
  return PlanResult(grid, std::move(*report));
}

std::vector<Violation> validatePaths(const Problem& problem, const std::vector<CellArray>& paths) {
  const CellPaths claimed = pathsOf(paths);
  std::vector<Violation> violations;
  Call call(-1);
  call.run([&] {
    const Deadline& deadline = call.deadline();
    violations = validate(instanceOf(problem, gridOf(problem, deadline)), claimed);
  });
  return violations;
}

/// A verdict in Python's words.
struct Verdict {
  std::string status;
  std::string reason;
  std::vector<std::uint32_t> robots;
  std::vector<Cell> cells;
};

Verdict check(const Problem& problem, double time_limit_sec) {
  Verdict verdict;
  Call call(time_limit_sec);
  call.run([&] {
    try {
      const std::shared_ptr<const Grid> grid = gridOf(problem, call.deadline());
      const SolvabilityVerdict found = checkSolvable(instanceOf(problem, grid), call.deadline());
      if (found.answer == Solvability::kUndecided) throw Interrupted();
      verdict.status = found.answer == Solvability::kSolvable ? "solvable" : "unsolvable";
      verdict.reason = explain(found, *grid);
      verdict.robots = found.robots;
      for (const Vertex v : found.vertices) verdict.cells.push_back(grid->cellOf(v));
    } catch (const Interrupted&) {
      verdict.status = "undecided";
      verdict.reason = "the time limit came first";
    }
  });
  return verdict;
}

BlockedArray readBlocked(const std::string& path, const OccupancyRule& rule) {
  const std::shared_ptr<const Grid> grid = readMap(path, rule);
  BlockedArray blocked(
      {static_cast<py::ssize_t>(grid->height()), static_cast<py::ssize_t>(grid->width())});
  bool* next = blocked.mutable_data();
  for (std::int32_t y = 0; y < static_cast<std::int32_t>(grid->height()); ++y) {
    for (std::int32_t x = 0; x < static_cast<std::int32_t>(grid->width()); ++x) {
      *next++ = !grid->isFree({x, y});
    }
  }
  return blocked;
}

py::tuple readScenario(const std::string& path, MapSize size, std::optional<std::uint32_t> agents) {
  const Scenario scenario = readMovingAiScenario(path, size, agents);
  return py::make_tuple(arrayOf(scenario.starts), arrayOf(scenario.goals));
}

const char* wordOf(ViolationKind kind) {
  switch (kind) {
    case ViolationKind::kRobotCount:
      return "robot_count";
    case ViolationKind::kEmptyPath:
      return "empty_path";
    case ViolationKind::kOutsideGrid:
      return "outside_grid";
    case ViolationKind::kWrongStart:
      return "wrong_start";
    case ViolationKind::kWrongGoal:
      return "wrong_goal";
    case ViolationKind::kJump:
      return "jump";
    case ViolationKind::kVertexConflict:
      return "vertex_conflict";
    case ViolationKind::kSwapConflict:
      return "swap_conflict";
  }
  return "";
}

void defineRequest(py::module& module) {
  py::class_<PlanRequest>(module, "Request", "What is asked, with the defaults of all doors.")
      .def(py::init<>())
      .def_readwrite("solver", &PlanRequest::solver)
      .def_readwrite("solver_options", &PlanRequest::solver_options)
      .def_readwrite("split", &PlanRequest::split)
      .def_readwrite("split_options", &PlanRequest::split_options)
      .def_property(
          "objective", [](const PlanRequest& r) { return toString(r.objective); },
          [](PlanRequest& r, const std::string& text) { r.objective = parseObjective(text); })
      .def_readwrite("suboptimality", &PlanRequest::suboptimality)
      .def_readwrite("time_limit", &PlanRequest::time_limit_sec)
      .def_readwrite("refine", &PlanRequest::refine_sec)
      .def_readwrite("straighten", &PlanRequest::straighten)
      .def_readwrite("seed", &PlanRequest::seed)
      .def_readwrite("threads", &PlanRequest::threads);
}

void defineProblem(py::module& module) {
  py::class_<Problem>(module, "Problem", "A map, and where robots start and end.")
      .def(py::init([](const py::object& map, int occupied_threshold, bool unknown_is_free,
                       const CellArray& starts, const CellArray& goals) {
        return problemOf(map, {occupied_threshold, unknown_is_free}, starts, goals);
      }));
}

void defineAnswers(py::module& module) {
  definePlanResult(module);
  py::class_<Violation>(module, "Violation", "One thing that is wrong with a plan.")
      .def_property_readonly("kind", [](const Violation& v) { return wordOf(v.kind); })
      .def_readonly("robot", &Violation::robot)
      .def_readonly("other", &Violation::other, "the second robot of a conflict")
      .def_readonly("step", &Violation::step)
      .def_readonly("message", &Violation::message)
      .def("__str__", [](const Violation& v) { return v.message; })
      .def("__repr__", [](const Violation& v) { return "<" + v.message + ">"; });
  py::class_<Verdict>(module, "Verdict", "Whether a plan exists: true where one does, proved.")
      .def_readonly("status", &Verdict::status, "solvable, unsolvable or undecided")
      .def_readonly("reason", &Verdict::reason, "one sentence")
      .def_readonly("robots", &Verdict::robots, "that are in the way, or cut off")
      .def_property_readonly("cells", [](const Verdict& v) { return arrayOf(v.cells); })
      .def("__bool__", [](const Verdict& v) { return v.status == "solvable"; })
      .def("__repr__", [](const Verdict& v) { return "<" + v.status + ": " + v.reason + ">"; });
}

}  // namespace

PYBIND11_MODULE(_core, module) {  // NOLINT: the macro's own code
  module.doc() = "The planner. Use it through the package split_mapf.";
  module.attr("__version__") = SPLIT_MAPF_VERSION;
  translateErrors();
  defineRequest(module);
  defineProblem(module);
  defineAnswers(module);
  module.def("plan", &plan);
  module.def("refine", &refine);
  module.def("validate", &validatePaths);
  module.def("check", &check);
  module.def("read_map", [](const std::string& path, int occupied_threshold, bool unknown_is_free) {
    return readBlocked(path, {occupied_threshold, unknown_is_free});
  });
  module.def("read_scenario", [](const std::string& path, std::uint32_t width, std::uint32_t height,
                                 std::optional<std::uint32_t> agents) {
    return readScenario(path, {width, height}, agents);
  });
  module.def("solvers", [] { return availableSolvers().names(); });
}

}  // namespace split_mapf::python
