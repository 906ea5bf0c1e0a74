#include <cstdint>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/io/cell_paths.h"
#include "split_mapf/io/disc_picture.h"
#include "split_mapf/io/movingai.h"
#include "split_mapf/io/picture.h"
#include "split_mapf/io/plan_json.h"
#include "split_mapf/io/pose_scenario.h"
#include "split_mapf/pipeline/disc_problem.h"
#include "tool/command_line.h"
#include "tool/commands.h"
#include "tool/disc_claims.h"
#include "tool/files.h"
#include "tool/robot_options.h"

namespace split_mapf::tool {
namespace {

constexpr std::uint32_t kMostCellPx = 256;
constexpr std::uint32_t kMostPhases = 1000000;

/// One end of a robot's path: where the plan has it, and where the scenario.
struct PathEnd {
  const char* what;
  Cell planned;
  Cell wanted;
};

/// Refuses a plan that belongs to another scenario. What else is wrong with it can be seen.
void requireMatch(const CellPaths& paths, const Scenario& scenario) {
  for (std::size_t robot = 0; robot < paths.size(); ++robot) {
    if (paths[robot].empty()) continue;
    for (const PathEnd& end : {PathEnd{"start", paths[robot].front(), scenario.starts[robot]},
                               PathEnd{"goal", paths[robot].back(), scenario.goals[robot]}}) {
      if (end.planned == end.wanted) continue;
      throw InputError("the plan is not for this scenario: robot " + std::to_string(robot) +
                       " has its " + end.what + " at " + toString(end.planned) +
                       ", in the scenario it is at " + toString(end.wanted));
    }
  }
}

/// The plan, over the regions of a phase where that was asked for.
Picture draw(const CommandLine& line, const Grid& grid, const CellPaths& paths,
             const PictureOptions& options) {
  if (!line.has("regions")) {
    if (line.has("phase")) throw OptionError("option --phase needs --regions");
    return drawPlan(grid, paths, options);
  }
  const std::string file = line.text("plan");
  const std::optional<Layout> layout = readPlanLayout(file, grid);
  if (!layout) {
    throw InputError(file + ": its `layout` is null: --regions needs a plan of a space split");
  }
  const auto phase = static_cast<std::uint32_t>(line.wholeNumber("phase", 0, 0, kMostPhases));
  return drawPlan(grid, paths, *layout, phase, options);
}

/// Robots that have size, over their own map.
Picture drawDiscPlan(const CommandLine& line, std::uint32_t cell_px) {
  for (const char* name : {"regions", "phase"}) {
    if (!line.has(name)) continue;
    throw OptionError(std::string("option --") + name + " needs robots without size");
  }
  const ClaimedDiscs claimed = readClaimedDiscs(line);
  const std::vector<std::string> wrong = wrongEnds(claimed);
  if (!wrong.empty()) throw InputError("the plan is not for this scenario: " + wrong.front());
  return drawDiscs(*claimed.files.task.raster, claimed.courses, claimed.discs.radius_m, cell_px);
}

void tell(const std::string& output, const Picture& picture, std::size_t robots) {
  std::cout << output << ": " << picture.width_px << "x" << picture.height_px << " pixels, "
            << counted(robots, "robot") << "\n";
}

}  // namespace

ExitCode runRender(const Call& call) {
  CommandLine line("render", "Draws a plan as a PNG picture.");
  line.require("map", "FILE", "MovingAI .map, or map_server .yaml");
  line.require("scen", "FILE", "MovingAI .scen, or .yaml with poses, that the plan is for");
  line.require("plan", "FILE", "JSON with `paths`, as `plan --output` writes it");
  line.require("output", "FILE", "write the picture as PNG");
  line.offerFlag("regions", "show the regions, buffers and intermediate states of a space split");
  line.offer("phase", "N", "with --regions: the phase to show, from 0 on (0)");
  line.offer("scale", "PIXELS", "pixels a cell, 1 to 256 (so that the picture has about 1000)");
  declareRobotSize(line);
  if (!line.parse(call.arguments)) return ExitCode::kOk;
  const RobotOptions robots = readRobotOptions(line);
  PictureOptions options;
  options.cell_px =
      static_cast<std::uint32_t>(line.wholeNumber("scale", options.cell_px, 1, kMostCellPx));
  const std::string output = line.text("output");
  requireWritable(output);
  if (asksForRoadmap(robots.roadmap) || isPoseScenario(line.text("scen"))) {
    const Picture picture = drawDiscPlan(line, options.cell_px);
    writePng(output, picture);
    tell(output, picture, readDiscPlanJson(line.text("plan")).poses.size());
    return ExitCode::kOk;
  }
  const auto grid = readMapOfPoints(line.text("map"), robots);
  const CellPaths paths = readPlanJson(line.text("plan"));
  if (paths.empty()) throw InputError(line.text("plan") + ": its `paths` are empty: no plan");
  requireMatch(paths, readMovingAiScenario(line.text("scen"), *grid,
                                           static_cast<std::uint32_t>(paths.size())));
  const Picture picture = draw(line, *grid, paths, options);
  writePng(output, picture);
  tell(output, picture, paths.size());
  return ExitCode::kOk;
}

}  // namespace split_mapf::tool
