#pragma once

#include <cstdint>
#include <functional>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/core/reservations.h"
#include "split_mapf/parallel/lent_threads.h"

namespace split_mapf {

/// Called with each better plan while a solver searches, from the thread that called it; the
/// reference holds during the call, which the search waits for.
using PlanSink = std::function<void(const Plan&)>;

/// One question to a solver. Everything it points to outlives the call.
struct SolveRequest {
  SolveRequest(const Instance& to_solve, Deadline until = {})
      : instance(to_solve), deadline(std::move(until)) {}

  const Instance& instance;
  Deadline deadline;  ///< polled by every loop that can run long
  /// Threads that the call may use beside the caller's own, see Executor::lend(). The plan does not
  /// depend on them.
  LentThreads threads;
  /// A valid plan to begin at, which keeps `reserved`; null: none is known. The answer costs no
  /// more.
  const Plan* known = nullptr;
  /// What the plan has to keep clear of; null: nothing is reserved.
  const Reservations* reserved = nullptr;
  /// Gets each better plan on the way; the answer's own may be the last of them. Null: nobody asks.
  PlanSink on_better;
  /// Called once where the search takes several times as long as it mostly does, from the thread
  /// that it runs on; then it goes on, and its answer is the same. Only `conflict_optimizer` calls
  /// it. Null: nobody asks.
  std::function<void()> on_late;
};

}  // namespace split_mapf
