#include "tool/plugin_options.h"

#include <string>

#include "solver/available/available_solvers.h"

namespace split_mapf::tool {

void declarePlugins(CommandLine& line) {
  line.offerRepeatable("solver-plugins", "FILE",
                       "a shared library with solvers and splitters; repeatable");
}

Methods readMethods(const CommandLine& line) {
  Methods methods;
  methods.solvers = availableSolvers();
  for (const std::string& file : line.texts("solver-plugins")) loadPlugins(file, methods);
  return methods;
}

}  // namespace split_mapf::tool
