#pragma once

#include <functional>
#include <string>

#include "split_mapf/solver/registry.h"

namespace split_mapf::test {

/// What a fake solver does when it is asked to solve.
using FakeSolve = std::function<SolveResult(const Instance&, const Deadline&)>;

/// A registered solver whose answers a test chooses: for pipeline tests of failures, exceptions
/// and interruptions that real solvers cannot be made to show on demand.
SolverInfo fakeSolver(const std::string& name, FakeSolve solve);

/// Waits until the deadline has expired, then answers kCancelled or kTimeout without a plan.
SolveResult waitForDeadline(const Instance& instance, const Deadline& deadline);

}  // namespace split_mapf::test
