#include "call.h"

#include <pybind11/pybind11.h>

#include <chrono>
#include <future>
#include <utility>

namespace split_mapf::python {
namespace {

namespace py = pybind11;

// How long a Ctrl-C may go unheard.
constexpr std::chrono::milliseconds kListenEach(20);

}  // namespace

void Call::show(const PlanReport& report) {
  if (!listener_) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  shown_ = report;
}

void Call::run(const std::function<void()>& work) {
  std::future<void> done = std::async(std::launch::async, work);
  const auto has_ended = [&done](std::chrono::milliseconds patience) {
    const py::gil_scoped_release others_may_run;
    return done.wait_for(patience) == std::future_status::ready;
  };
  try {
    while (!has_ended(kListenEach)) serve();
    handOn();
  } catch (...) {
    stop_->request();
    {
      const py::gil_scoped_release others_may_run;
      done.wait();
    }
    throw;
  }
  done.get();
}

void Call::serve() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  handOn();
}

void Call::handOn() {
  std::optional<PlanReport> report;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    report.swap(shown_);
  }
  if (report && !listener_(*report)) stop_->request();
}

}  // namespace split_mapf::python
