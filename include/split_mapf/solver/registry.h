#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "split_mapf/core/option_info.h"
#include "split_mapf/solver/solver.h"

namespace split_mapf {

/// A registered solver.
struct SolverInfo {
  std::string name;
  std::string description;
  SolverTraits traits;  ///< of every solver that `make` builds
  std::vector<OptionInfo> options;
  /// Values of options with which it keeps no table of a bit a cell and step.
  std::map<std::string, std::string> lean_values;
  /// Builds a solver. @throws OptionError for a value out of range.
  std::function<std::unique_ptr<Solver>(const SolverOptions&)> make;
};

using SolverTable = std::map<std::string, SolverTraits>;

/// Solvers by name. Filled once, then only read: reading is thread-safe.
class SolverRegistry {
 public:
  /// @throws std::invalid_argument when the name is taken.
  void add(SolverInfo info);
  /// In order of names.
  std::vector<std::string> names() const;
  /// Of all solvers, by name.
  SolverTable traits() const;
  /// @throws UnknownSolverError listing what there is.
  const SolverInfo& info(const std::string& name) const;
  /// Builds a solver, after checking that it plans for the objective and that every option is one
  /// that it offers.
  /// @throws UnknownSolverError, OptionError.
  std::unique_ptr<Solver> create(const std::string& name, const SolverOptions& options) const;

 private:
  std::map<std::string, SolverInfo> solvers_;
};

/// The solvers of this package.
const SolverRegistry& builtinSolvers();

}  // namespace split_mapf
