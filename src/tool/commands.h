#pragma once

#include <string>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "tool/exit_code.h"

namespace split_mapf::tool {

/// One call of the program.
struct Call {
  std::vector<std::string> arguments;         ///< behind the name of the subcommand
  Deadline::Clock::time_point begin_of_call;  ///< time limits count from here
};

/// A subcommand. `run` throws InputError for bad usage and bad input.
struct Command {
  std::string name;
  std::string summary;
  ExitCode (*run)(const Call& call);
};

ExitCode runPlan(const Call& call);
ExitCode runValidate(const Call& call);
ExitCode runCheck(const Call& call);
ExitCode runConvert(const Call& call);
ExitCode runGenerate(const Call& call);
ExitCode runRender(const Call& call);
ExitCode runRoadmap(const Call& call);
ExitCode runBench(const Call& call);
ExitCode runSimulate(const Call& call);
ExitCode runRoll(const Call& call);
ExitCode runSolvers(const Call& call);
ExitCode runWorker(const Call& call);

}  // namespace split_mapf::tool
