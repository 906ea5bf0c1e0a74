#include <cstdint>
#include <filesystem>
#include <iostream>
#include <limits>

#include "split_mapf/core/error.h"
#include "split_mapf/core/generator.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/io/movingai.h"
#include "tool/command_line.h"
#include "tool/commands.h"
#include "tool/files.h"

namespace split_mapf::tool {
namespace {

GeneratorOptions readOptions(const CommandLine& line) {
  constexpr std::uint64_t kMost32 = std::numeric_limits<std::uint32_t>::max();
  GeneratorOptions options;
  if (line.has("type")) options.kind = parseMapKind(line.text("type"));
  options.width = static_cast<std::uint32_t>(line.wholeNumber("width", options.width, 1, kMost32));
  options.height =
      static_cast<std::uint32_t>(line.wholeNumber("height", options.height, 1, kMost32));
  if (line.has("density")) options.density = line.number("density", 0, 0);
  options.robots =
      static_cast<std::uint32_t>(line.wholeNumber("agents", options.robots, 1, kMost32));
  options.seed =
      line.wholeNumber("seed", options.seed, 0, std::numeric_limits<std::uint64_t>::max());
  return options;
}

}  // namespace

ExitCode runGenerate(const Call& call) {
  const GeneratorOptions defaults;
  CommandLine line("generate",
                   "Generates a map and a scenario: robots with random distinct starts and goals,\n"
                   "none of them cut off. The same options give the same files everywhere.");
  line.offer("type", "NAME", "random, warehouse or rooms (" + toString(defaults.kind) + ")");
  line.offer("width", "CELLS", "width of the map (" + std::to_string(defaults.width) + ")");
  line.offer("height", "CELLS", "height of the map (" + std::to_string(defaults.height) + ")");
  line.offer("density", "SHARE", "share of blocked cells of a random map, 0 <= SHARE < 1 (0.1)");
  line.offer("agents", "N", "number of robots (" + std::to_string(defaults.robots) + ")");
  line.offer("seed", "N", "all randomness (" + std::to_string(defaults.seed) + ")");
  line.require("output-map", "FILE", "write the map as MovingAI .map");
  line.require("output-scen", "FILE", "write the scenario as MovingAI .scen");
  if (!line.parse(call.arguments)) return ExitCode::kOk;
  const std::string map_file = line.text("output-map");
  const std::string scenario_file = line.text("output-scen");
  const GeneratorOptions options = readOptions(line);
  if (map_file == scenario_file) {
    throw OptionError("options --output-map and --output-scen name the same file " + map_file);
  }
  requireWritable(map_file);
  requireWritable(scenario_file);
  const GeneratedProblem problem = generateProblem(options);
  writeMovingAiMap(map_file, *problem.grid);
  writeMovingAiScenario(scenario_file, std::filesystem::path(map_file).filename().string(),
                        *problem.grid, {problem.starts, problem.goals});
  std::cout << toString(options.kind) << " map of " << options.width << "x" << options.height
            << " cells, " << problem.grid->size() << " of them free, "
            << counted(options.robots, "robot") << ", seed " << options.seed << ": " << map_file
            << ", " << scenario_file << "\n";
  return ExitCode::kOk;
}

}  // namespace split_mapf::tool
