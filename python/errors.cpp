#include "errors.h"

#include <pybind11/pybind11.h>

#include <exception>
#include <string>

#include "problem.h"
#include "split_mapf/core/error.h"

namespace split_mapf::python {
namespace {

namespace py = pybind11;

const char* wordOf(FaultKind kind) {
  switch (kind) {
    case FaultKind::kOutsideMap:
      return "outside_map";
    case FaultKind::kBlockedCell:
      return "blocked_cell";
    case FaultKind::kDuplicateStart:
      return "duplicate_start";
    case FaultKind::kDuplicateGoal:
      return "duplicate_goal";
  }
  return "";
}

py::object classOf(const char* name) { return py::module::import("split_mapf.errors").attr(name); }

/// Names of files need not be UTF-8.
py::object textOf(const std::string& text) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace"));
}

void raise(const char* name, const std::string& message) {
  const py::object type = classOf(name);
  PyErr_SetObject(type.ptr(), type(textOf(message)).ptr());
}

void raise(const FaultyCells& error) {
  const py::object type = classOf("InstanceError");
  const py::object fault_type = classOf("Fault");
  py::list faults;
  for (std::size_t i = 0; i < error.faults().size(); ++i) {
    const InstanceFault& fault = error.faults()[i];
    const Cell cell = error.cells()[i];
    faults.append(fault_type(fault.robot, py::make_tuple(cell.x, cell.y), wordOf(fault.kind),
                             textOf(fault.message)));
  }
  PyErr_SetObject(type.ptr(), type(textOf(error.what()), faults).ptr());
}

}  // namespace

void translateErrors() {
  // NOLINTNEXTLINE(performance-unnecessary-value-param): pybind11 says how it is passed
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const FaultyCells& error) {
      raise(error);
    } catch (const UnknownSolverError& error) {
      raise("UnknownSolverError", error.what());
    } catch (const SplitSpecError& error) {
      raise("SplitSpecError", error.what());
    } catch (const OptionError& error) {
      raise("OptionError", error.what());
    } catch (const InputError& error) {
      raise("InputError", error.what());
    }
  });
}

}  // namespace split_mapf::python
