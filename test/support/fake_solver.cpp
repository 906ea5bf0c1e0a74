#include "support/fake_solver.h"

#include <chrono>
#include <memory>
#include <thread>
#include <utility>

#include "split_mapf/pipeline/planner.h"
#include "split_mapf/solver/ecbs.h"

namespace split_mapf::test {
namespace {

class FakeSolver : public Solver {
 public:
  explicit FakeSolver(FakeSolve solve) : solve_(std::move(solve)) {}
  SolveResult solve(const Instance& instance, const Deadline& deadline) const override {
    return solve_(instance, deadline);
  }

 private:
  FakeSolve solve_;
};

}  // namespace

SolverInfo fakeSolver(const std::string& name, FakeSolve solve) {
  SolverInfo info;
  info.name = name;
  info.description = "answers as the test says";
  info.make = [solve = std::move(solve)](const SolverOptions&) {
    return std::make_unique<FakeSolver>(solve);
  };
  return info;
}

SolveResult waitForDeadline(const Instance& /*instance*/, const Deadline& deadline) {
  while (!deadline.expired()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  SolveResult result;
  result.termination = deadline.stopRequested() ? Termination::kCancelled : Termination::kTimeout;
  return result;
}

PickySolver::PickySolver(std::function<bool(const Instance&)> refuses)
    : refuses_(std::move(refuses)) {
  registry_.add(fakeSolver("picky", [this](const Instance& piece, const Deadline& deadline) {
    ++calls_;
    if (!refuses_(piece)) return EcbsSolver(SolverOptions()).solve(piece, deadline);
    SolveResult failure;
    failure.termination = Termination::kNoPlanFound;
    failure.message = "picky";
    return failure;
  }));
}

PlanReport PickySolver::plan(const Instance& instance, const std::string& split,
                             std::uint32_t threads) const {
  return planWith(registry_, "picky", instance, split, threads);
}

PlanReport planWith(const SolverRegistry& registry, const std::string& solver,
                    const Instance& instance, const std::string& split, std::uint32_t threads) {
  Executor executor(threads);
  PlanRequest request;
  request.solver = solver;
  request.split = split;
  return Planner(registry, executor).plan(instance, request, Deadline());
}

}  // namespace split_mapf::test
