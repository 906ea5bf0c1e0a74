#include "split_mapf/solver/registry.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/solver/conflict_optimizer.h"
#include "split_mapf/solver/ecbs.h"
#include "split_mapf/solver/joint.h"
#include "split_mapf/solver/lacam.h"
#include "split_mapf/solver/prioritized.h"

namespace split_mapf {
namespace {

std::string join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text += ", ";
    text += word;
  }
  return text.empty() ? "none" : text;
}

}  // namespace

void SolverRegistry::add(SolverInfo info) {
  const std::string name = info.name;
  if (!solvers_.emplace(name, std::move(info)).second) {
    throw std::invalid_argument("solver " + quote(name) + " is registered already");
  }
}

std::vector<std::string> SolverRegistry::names() const {
  std::vector<std::string> names;
  for (const auto& entry : solvers_) names.push_back(entry.first);
  return names;
}

SolverTable SolverRegistry::traits() const {
  SolverTable table;
  for (const auto& [name, info] : solvers_) table[name] = info.traits;
  return table;
}

const SolverInfo& SolverRegistry::info(const std::string& name) const {
  const auto found = solvers_.find(name);
  if (found == solvers_.end()) {
    throw UnknownSolverError("solver " + quote(name) + " is unknown; available: auto, " +
                             join(names()));
  }
  return found->second;
}

std::unique_ptr<Solver> SolverRegistry::create(const std::string& name,
                                               const SolverOptions& options) const {
  const SolverInfo& solver = info(name);
  if (!plansFor(solver.traits, options.objective)) {
    throw OptionError("solver " + quote(name) + " does not plan for " +
                      toString(options.objective));
  }
  for (const auto& [option, value] : options.values) {
    const bool known =
        std::any_of(solver.options.begin(), solver.options.end(),
                    [&option = option](const OptionInfo& o) { return o.name == option; });
    if (known) continue;
    std::vector<std::string> offered;
    for (const OptionInfo& o : solver.options) offered.push_back(o.name);
    throw OptionError("solver " + quote(name) + " has no option " + quote(option) +
                      "; it offers: " + join(offered));
  }
  return solver.make(options);
}

const SolverRegistry& builtinSolvers() {
  static const SolverRegistry registry = [] {
    SolverRegistry solvers;
    solvers.add(ConflictOptimizerSolver::info());
    solvers.add(EcbsSolver::info());
    solvers.add(JointSolver::info());
    solvers.add(LacamSolver::info());
    solvers.add(PrioritizedSolver::info());
    return solvers;
  }();
  return registry;
}

}  // namespace split_mapf
