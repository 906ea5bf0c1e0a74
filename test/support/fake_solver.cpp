#include "support/fake_solver.h"

#include <chrono>
#include <memory>
#include <thread>
#include <utility>

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

}  // namespace split_mapf::test
