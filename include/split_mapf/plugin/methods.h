#pragma once

#include <memory>
#include <string>

#include "split_mapf/plugin/solver_plugin.h"
#include "split_mapf/plugin/splitter_plugin.h"
#include "split_mapf/solver/registry.h"
#include "split_mapf/split/splitter_registry.h"

namespace split_mapf {

/// What a program offers: its own solvers and splitters, and those of plug-ins. Filled at its
/// start, then only read.
struct Methods {
  SolverRegistry solvers;
  SplitterRegistry splitters = builtinSplitters();
};

/// Adds the solver of a plug-in, guarded: whatever it does when it is asked, short of a crash, the
/// answer is a result that has been checked, half a second after its deadline at the latest.
/// Once added it is never destroyed, as a call that was given up may use it until the program ends.
/// @param origin  where it comes from, as messages name it: a file, or a class of a package.
/// @throws OptionError naming the origin where its name is no name or taken, it was built for
/// another version, or it throws.
void addSolver(std::shared_ptr<const SolverPlugin> plugin, const std::string& origin,
               Methods& methods);
/// The same for a splitter, which may not claim the paper's notation. What it does wrong is
/// thrown as SplitterFailure.
void addSplitter(std::shared_ptr<const SplitterPlugin> plugin, const std::string& origin,
                 Methods& methods);

/// Loads a shared library and adds all plug-ins that it exports, see SPLIT_MAPF_EXPORT_PLUGINS. It
/// is never unloaded. @throws OptionError naming the file.
void loadPlugins(const std::string& file, Methods& methods);

/// Calls of plug-ins that were given up and have not come back by now, each with a thread that
/// cannot be stopped. While there are some a program ends by std::_Exit, as such a thread may use
/// anything that an ordinary exit takes down. Thread-safe.
int abandonedCalls();

}  // namespace split_mapf
