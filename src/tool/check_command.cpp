#include <cstdint>
#include <iostream>
#include <limits>
#include <optional>

#include "split_mapf/core/instance.h"
#include "split_mapf/io/map_file.h"
#include "split_mapf/io/movingai.h"
#include "split_mapf/solvability/solvability.h"
#include "tool/command_line.h"
#include "tool/commands.h"

namespace split_mapf::tool {

ExitCode runCheck(const Call& call) {
  CommandLine line("check",
                   "Decides, without planning, whether a plan exists.\n"
                   "Exit code: 0 solvable, 2 unsolvable; the reason names robots and cells.");
  line.require("map", "FILE", "MovingAI .map, or map_server .yaml");
  line.require("scen", "FILE", "MovingAI .scen");
  line.offer("agents", "N", "the scenario's first N rows (all)");
  if (!line.parse(call.arguments)) return ExitCode::kOk;
  const auto grid = readMap(line.text("map"));
  std::optional<std::uint32_t> agents;
  if (line.has("agents")) {
    agents = static_cast<std::uint32_t>(
        line.wholeNumber("agents", 1, 1, std::numeric_limits<std::uint32_t>::max()));
  }
  const Scenario scenario = readMovingAiScenario(line.text("scen"), *grid, agents);
  const Instance instance(grid, scenario.starts, scenario.goals);
  const SolvabilityVerdict verdict = checkSolvable(instance);
  if (verdict.answer == Solvability::kSolvable) {
    std::cout << "solvable\n";
    return ExitCode::kOk;
  }
  std::cout << "unsolvable: " << explain(verdict, *grid) << "\n";
  return ExitCode::kUnsolvable;
}

}  // namespace split_mapf::tool
