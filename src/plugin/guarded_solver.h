#pragma once

#include <memory>
#include <string>

#include "plugin/watched_call.h"
#include "split_mapf/solver/solver.h"

namespace split_mapf {

/// What a plug-in's solver may be asked for: see SolverPlugin.
SolverTraits guardedTraits(SolverTraits traits);

/// A solver of a plug-in, of which nothing is believed that can be checked. Whatever it does, the
/// answer is a result: no plan where it throws, contradicts itself or returns a wrong plan; a
/// time-out, or a cancel, where it does not stop, and no plan for who asks it as long as that
/// search goes on.
class GuardedSolver : public Solver {
 public:
  /// @param called  as messages name it. @param watch  of all solvers of the plug-in.
  GuardedSolver(const std::string& name, std::string called, const SolverTraits& traits,
                std::shared_ptr<const Solver> inner, Objective objective,
                std::shared_ptr<CallWatch> watch)
      : Solver(name, traits),
        called_(std::move(called)),
        inner_(std::move(inner)),
        objective_(objective),
        watch_(std::move(watch)) {}

 private:
  SolveResult run(const SolveRequest& request) const override;
  SolveResult ask(const SolveRequest& request) const;
  /// The result where it holds, and what is wrong with it otherwise.
  SolveResult checked(SolveResult result, const SolveRequest& request) const;
  SolveResult checkedPlan(SolveResult result, const SolveRequest& request) const;
  SolveResult checkedRefusal(SolveResult result, const SolveRequest& request) const;
  SolveResult noPlan(const std::string& why) const;

  const std::string called_;
  const std::shared_ptr<const Solver> inner_;
  const Objective objective_;
  const std::shared_ptr<CallWatch> watch_;
};

}  // namespace split_mapf
