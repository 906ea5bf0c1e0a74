// The command-line tool: picks the subcommand, and turns what it throws into exit codes.
#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/pipeline/disc_problem.h"
#include "split_mapf/plugin/methods.h"
#include "tool/commands.h"

namespace split_mapf::tool {
namespace {

const std::vector<Command>& commands() {
  static const std::vector<Command> list = {
      {"plan", "plan collision-free paths", runPlan},
      {"validate", "check a plan and list every violation", runValidate},
      {"check", "decide whether a plan exists", runCheck},
      {"convert", "write a map and a scenario as JSON", runConvert},
      {"generate", "generate a map and a scenario", runGenerate},
      {"render", "draw a plan as a PNG picture", runRender},
      {"simulate", "execute a plan by robots that are late", runSimulate},
      {"roll", "run a fleet whose goals come one by one", runRoll},
      {"roadmap", "build the planning graph of robots that have size", runRoadmap},
      {"bench", "plan many combinations and write a CSV table", runBench},
      {"solvers", "list solvers and their options", runSolvers},
      {"worker", "solve pieces for calls on other machines", runWorker},
  };
  return list;
}

void printHelp() {
  std::cout << "Usage: split_mapf COMMAND [options]\n\n"
               "Plans collision-free paths for many robots on a grid.\n\nCommands\n";
  for (const Command& command : commands()) {
    std::cout << "  " << command.name << std::string(12 - command.name.size(), ' ')
              << command.summary << "\n";
  }
  std::cout << "\nOptions of a command: split_mapf COMMAND --help\n"
               "Version: split_mapf --version\n";
}

[[noreturn]] void refuse(const std::string& what) {
  std::string names;
  for (const Command& command : commands()) names += (names.empty() ? "" : ", ") + command.name;
  throw OptionError(what + "; available commands: " + names);
}

ExitCode run(const std::vector<std::string>& arguments, Deadline::Clock::time_point begin_of_call) {
  if (arguments.empty()) refuse("no command was given");
  const std::string& name = arguments.front();
  if (name == "--help" || name == "--version") {
    if (arguments.size() > 1) throw OptionError("unexpected argument " + quote(arguments[1]));
    if (name == "--help") {
      printHelp();
    } else {
      std::cout << "split_mapf " << SPLIT_MAPF_VERSION << "\n";
    }
    return ExitCode::kOk;
  }
  for (const Command& command : commands()) {
    if (command.name != name) continue;
    return command.run({{arguments.begin() + 1, arguments.end()}, begin_of_call});
  }
  refuse("command " + quote(name) + " is unknown");
}

/// The one place where exceptions end.
ExitCode runAndReport(const std::vector<std::string>& arguments,
                      Deadline::Clock::time_point begin_of_call) {
  try {
    const ExitCode code = run(arguments, begin_of_call);
    std::cout.flush();
    if (!std::cout) throw InputError("standard output cannot be written");
    return code;
  } catch (const InstanceError& e) {
    for (const InstanceFault& fault : e.faults())
      std::cerr << "split_mapf: " << fault.message << "\n";
    return ExitCode::kBadInput;
  } catch (const AttachmentError& e) {
    for (const std::string& message : e.messages()) std::cerr << "split_mapf: " << message << "\n";
    return ExitCode::kBadInput;
  } catch (const InputError& e) {
    std::cerr << "split_mapf: " << e.what() << "\n";
    return ExitCode::kBadInput;
  } catch (const std::bad_alloc&) {
    std::cerr << "split_mapf: memory ran out\n";
    return ExitCode::kMemoryLimit;
  } catch (const std::exception& e) {
    std::cerr << "split_mapf: internal error: " << e.what() << "\n";
    return ExitCode::kInternalError;
  }
}

}  // namespace
}  // namespace split_mapf::tool

int main(int argc, char** argv) {
  const auto begin_of_call = split_mapf::Deadline::Clock::now();
  // A file that grows beyond a limit is an error of writing, as on a full disk, and no end.
  std::signal(SIGXFSZ, SIG_IGN);
  const std::vector<std::string> arguments(argv + (argc > 0 ? 1 : 0), argv + argc);
  const int code = static_cast<int>(split_mapf::tool::runAndReport(arguments, begin_of_call));
  // A plug-in's thread that does not stop may use what an ordinary exit takes down.
  if (split_mapf::abandonedCalls() > 0) std::_Exit(code);
  return code;
}
