#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "split_mapf/core/plan_report.h"
#include "split_mapf/solver/registry.h"

namespace split_mapf::test {

/// What a fake solver does when it is asked to solve.
using FakeSolve = std::function<SolveResult(const Instance&, const Deadline&)>;

/// A registered solver whose answers a test chooses: for pipeline tests of failures, exceptions
/// and interruptions that real solvers cannot be made to show on demand.
SolverInfo fakeSolver(const std::string& name, FakeSolve solve, const SolverTraits& traits = {});

/// Waits until the deadline has expired, then answers kCancelled or kTimeout without a plan.
SolveResult waitForDeadline(const Instance& instance, const Deadline& deadline);

/// A registry with one solver, `picky`: ECBS that fails for the pieces that a test names, and
/// counts its calls.
class PickySolver {
 public:
  explicit PickySolver(std::function<bool(const Instance&)> refuses);
  PlanReport plan(const Instance& instance, const std::string& split, std::uint32_t threads) const;
  int calls() const { return calls_; }

 private:
  std::function<bool(const Instance&)> refuses_;
  std::atomic<int> calls_{0};
  SolverRegistry registry_;
};

/// A plan by one of a registry's solvers, without a limit of time.
PlanReport planWith(const SolverRegistry& registry, const std::string& solver,
                    const Instance& instance, const std::string& split, std::uint32_t threads);

}  // namespace split_mapf::test
