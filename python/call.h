#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/plan_report.h"

namespace split_mapf::python {

/// One call from Python: its work is done in a thread of its own, while the thread that called
/// holds no lock of the interpreter, listens to Ctrl-C and hands better plans on. For one use.
class Call {
 public:
  /// Told of a better plan, with the interpreter's lock held; false: it is good enough.
  using Listener = std::function<bool(const PlanReport&)>;

  /// @param time_limit_sec  from now on.
  explicit Call(double time_limit_sec, Listener listener = nullptr)
      : stop_(std::make_shared<StopFlag>()),
        deadline_(time_limit_sec, stop_),
        listener_(std::move(listener)) {}

  /// That of the work: Ctrl-C ends it too.
  const Deadline& deadline() const { return deadline_; }
  /// From the work's thread: a plan to be handed on. Of several that the listener has no time for
  /// it gets the last.
  void show(const PlanReport& report);
  /// Returns when the work has ended. Rethrows what it threw; or what Python raised meanwhile,
  /// which is KeyboardInterrupt, or the listener's own, and which ends the work.
  /// @pre the interpreter's lock is held.
  void run(const std::function<void()>& work);

 private:
  void serve();
  void handOn();

  std::shared_ptr<StopFlag> stop_;
  Deadline deadline_;
  Listener listener_;
  std::mutex mutex_;
  std::optional<PlanReport> shown_;  // guarded by mutex_
};

}  // namespace split_mapf::python
