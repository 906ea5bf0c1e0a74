#pragma once

#include "split_mapf/plugin/plugin_interface.h"
#include "split_mapf/solver/registry.h"

namespace split_mapf {

/// Brings a solver of somebody else to the programs of this package, see plugin/methods.h. One
/// derives from this and from Solver, and exports the class (plugin/export_plugins.h).
///
/// What the programs hold the solver to, whatever it does: it runs in a thread of its own, is given
/// up half a second after its deadline, and what it answers is checked; see docs/plugins.md. It is
/// asked only where it is named: never by `auto`, as a fallback, or for refinement; and never for
/// what those need, which are known plans, reserved paths, better plans on the way and threads.
class SolverPlugin : public Plugin {
 public:
  /// The solver. Called once; this object lives as long as the program. `make` returns at once:
  /// work belongs into Solver::run(). Its errors are OptionError.
  virtual SolverInfo info() const = 0;
};

}  // namespace split_mapf
