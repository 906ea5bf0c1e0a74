#include <cstdint>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/generate/generator.h"
#include "split_mapf/generate/pose_generator.h"
#include "split_mapf/io/movingai.h"
#include "split_mapf/io/pose_scenario.h"
#include "split_mapf/pipeline/disc_problem.h"
#include "tool/command_line.h"
#include "tool/commands.h"
#include "tool/disc_task.h"
#include "tool/files.h"
#include "tool/robot_options.h"

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

/// @throws OptionError naming an option that makes a map.
void requireNoMapOptions(const CommandLine& line) {
  for (const char* name : {"type", "width", "height", "density", "output-map"}) {
    if (line.has(name)) {
      throw OptionError(std::string("option --") + name + " makes a map; --map names one");
    }
  }
}

/// @param map_file  whose name the scenario's rows say.
void writeScenario(const std::string& path, const std::string& map_file,
                   const GeneratedProblem& problem) {
  writeMovingAiScenario(path, std::filesystem::path(map_file).filename().string(), *problem.grid,
                        {problem.starts, problem.goals});
}

/// Cells on a map that is there already.
ExitCode generateCells(const CommandLine& line, const RobotOptions& options) {
  const std::string output = line.text("output-scen");
  if (asksForRoadmap(options.roadmap)) {
    throw OptionError("option --output-scen: " + quote(output) +
                      " was given, a .yaml is expected for poses");
  }
  requireNoGraphOptions(line);
  requireWritable(output);
  const GeneratorOptions wanted = readOptions(line);
  const std::string map_file = line.text("map");
  const GeneratedProblem problem =
      drawRobots(readMapOfPoints(map_file, options), wanted.robots, wanted.seed);
  writeScenario(output, map_file, problem);
  std::cout << counted(wanted.robots, "robot") << " on " << problem.grid->size()
            << " free cells, seed " << wanted.seed << ": " << output << "\n";
  return ExitCode::kOk;
}

/// Poses on a map that is there already.
ExitCode generatePoses(const CommandLine& line, const RobotOptions& options) {
  const std::string output = line.text("output-scen");
  requireWritable(output);
  const GeneratorOptions wanted = readOptions(line);
  const OccupancyMap map = readMapInMetres(line.text("map"), options);
  PoseDraw draw;
  draw.raster = std::make_shared<const ObstacleRaster>(obstaclesOf(map, options));
  draw.roadmap = options.roadmap;
  draw.snap_distance_m = options.snap_distance_m;
  draw.robots = wanted.robots;
  draw.seed = wanted.seed;
  const DrawnPoses drawn = drawPoses(draw);
  const MapFrame frame = frameOf(map);
  std::vector<PosedRobot> robots;
  for (std::size_t i = 0; i < drawn.robots.size(); ++i) {
    const MapPoint start = toFrame(frame, drawn.robots[i].start);
    const MapPoint goal = toFrame(frame, drawn.robots[i].goal);
    robots.push_back({"r" + std::to_string(i),
                      {start.x, start.y, drawn.start_yaws_rad[i]},
                      {goal.x, goal.y, drawn.goal_yaws_rad[i]},
                      std::nullopt});
  }
  const std::string what = counted(draw.robots, "robot") + " of radius " +
                           inMetres(draw.roadmap.robot_radius_m) + ", seed " +
                           std::to_string(draw.seed);
  writePoseScenario(output, robots, what + ": id, start and goal [x m, y m, yaw rad]");
  std::cout << what << ", " << drawn.left_out
            << " more were drawn where no planning graph serves them: " << output << "\n";
  return ExitCode::kOk;
}

}  // namespace

ExitCode runGenerate(const Call& call) {
  const GeneratorOptions defaults;
  CommandLine line(
      "generate",
      "Generates a map and a scenario: robots with random distinct starts and goals,\n"
      "none of them cut off. The same options give the same files everywhere.\n"
      "With --map: robots on a map that is there, at cells (--output-scen FILE.scen) or\n"
      "at poses of robots that have size (FILE.yaml).");
  line.offer("type", "NAME", "random, warehouse or rooms (" + toString(defaults.kind) + ")");
  line.offer("width", "CELLS", "width of the map (" + std::to_string(defaults.width) + ")");
  line.offer("height", "CELLS", "height of the map (" + std::to_string(defaults.height) + ")");
  line.offer("density", "SHARE", "share of blocked cells of a random map, 0 <= SHARE < 1 (0.1)");
  line.offer("agents", "N", "number of robots (" + std::to_string(defaults.robots) + ")");
  line.offer("seed", "N", "all randomness (" + std::to_string(defaults.seed) + ")");
  line.offer("map", "FILE", "draw robots on this map: MovingAI .map, or map_server .yaml");
  declareRobotOptions(line);
  line.offer("output-map", "FILE", "write the map as MovingAI .map");
  line.require("output-scen", "FILE", "write the scenario as MovingAI .scen, or poses as .yaml");
  if (!line.parse(call.arguments)) return ExitCode::kOk;
  if (line.has("map")) {
    requireNoMapOptions(line);
    const RobotOptions options = readRobotOptions(line);
    return isPoseScenario(line.text("output-scen")) ? generatePoses(line, options)
                                                    : generateCells(line, options);
  }
  if (!line.has("output-map"))
    throw OptionError("option --output-map, or --map, is needed; see split_mapf generate --help");
  if (asksForRoadmap(readRobotOptions(line).roadmap)) {
    throw OptionError("robots that have size need a map in metres: --map FILE.yaml");
  }
  requireNoGraphOptions(line);
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
  writeScenario(scenario_file, map_file, problem);
  std::cout << toString(options.kind) << " map of " << options.width << "x" << options.height
            << " cells, " << problem.grid->size() << " of them free, "
            << counted(options.robots, "robot") << ", seed " << options.seed << ": " << map_file
            << ", " << scenario_file << "\n";
  return ExitCode::kOk;
}

}  // namespace split_mapf::tool
