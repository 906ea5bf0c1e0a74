#include <iomanip>
#include <iostream>

#include "split_mapf/plugin/methods.h"
#include "tool/command_line.h"
#include "tool/commands.h"
#include "tool/plugin_options.h"

namespace split_mapf::tool {
namespace {

void printOption(const OptionInfo& option) {
  std::cout << "  " << option.name << "=" << option.default_value << "\n      "
            << option.description << "\n";
}

}  // namespace

ExitCode runSolvers(const Call& call) {
  CommandLine line("solvers", "Lists the solvers with their options, then the split options.");
  declarePlugins(line);
  if (!line.parse(call.arguments)) return ExitCode::kOk;
  const Methods methods = readMethods(line);
  for (const std::string& name : methods.solvers.names()) {
    const SolverInfo& solver = methods.solvers.info(name);
    std::cout << name << "\n    " << solver.description << "\n";
    for (const OptionInfo& option : solver.options) printOption(option);
  }
  for (const std::string& name : methods.splitters.names()) {
    const SplitterInfo& splitter = methods.splitters.info(name);
    std::cout << "\nsplit options of splits made by " << name << "\n    " << splitter.description
              << "\n";
    for (const OptionInfo& option : splitter.options) printOption(option);
  }
  std::cout << "\nsplit options of all splits\n";
  for (const OptionInfo& option : splitOptions()) printOption(option);
  return ExitCode::kOk;
}

}  // namespace split_mapf::tool
