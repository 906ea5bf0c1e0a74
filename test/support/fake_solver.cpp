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
  FakeSolver(const std::string& name, const SolverTraits& traits, FakeSolve solve)
      : Solver(name, traits), solve_(std::move(solve)) {}

 private:
  SolveResult run(const SolveRequest& request) const override {
    return solve_(request.instance, request.deadline);
  }

  FakeSolve solve_;
};

}  // namespace

SolverInfo fakeSolver(const std::string& name, FakeSolve solve, const SolverTraits& traits) {
  SolverInfo info;
  info.name = name;
  info.description = "answers as the test says";
  info.traits = traits;
  info.make = [name, traits, solve = std::move(solve)](const SolverOptions&) {
    return std::make_unique<FakeSolver>(name, traits, solve);
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
