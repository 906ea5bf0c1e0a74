#include <algorithm>
#include <cmath>
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
#include "split_mapf/io/gif.h"
#include "split_mapf/io/movingai.h"
#include "split_mapf/io/picture.h"
#include "split_mapf/io/plan_film.h"
#include "split_mapf/io/plan_json.h"
#include "split_mapf/io/pose_scenario.h"
#include "split_mapf/pipeline/disc_problem.h"
#include "tool/command_line.h"
#include "tool/commands.h"
#include "tool/disc_claims.h"
#include "tool/files.h"
#include "tool/robot_options.h"
#include "tool/video.h"

namespace split_mapf::tool {
namespace {

constexpr std::uint32_t kMostCellPx = 256;
constexpr std::uint32_t kMostPhases = 1000000;
constexpr int kFramesPerSec = 20;
constexpr int kMostFrames = 6000;
constexpr double kLeastFilmSec = 2;
constexpr double kAutomaticFilmSec = 20;
constexpr double kFilmSecPerStep = 0.25;
constexpr std::uint32_t kFilmSidePx = 500;

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

/// What is to be drawn, where not the whole paths.
struct Wishes {
  std::optional<double> at_step;
  bool heat = false;
  std::string film_file;                ///< empty: no film
  std::optional<double> film_duration;  ///< [s]
};

Wishes readWishes(const CommandLine& line) {
  Wishes wishes;
  if (line.has("at")) wishes.at_step = line.number("at", 0, 0);
  wishes.heat = line.has("heat");
  wishes.film_file = line.text("animate", "");
  if (line.has("duration")) {
    if (wishes.film_file.empty()) throw OptionError("option --duration needs --animate");
    wishes.film_duration = line.number("duration", 1, kLeastFilmSec);
  }
  const int views = int{wishes.at_step.has_value()} + int{wishes.heat} + int{line.has("regions")};
  if (views > 1) throw OptionError("one of --at, --heat and --regions is expected, not several");
  if (views > 0 && !line.has("output")) {
    throw OptionError("options --at, --heat and --regions need --output");
  }
  if (line.has("phase") && !line.has("regions")) {
    throw OptionError("option --phase needs --regions");
  }
  if (!line.has("output") && wishes.film_file.empty()) {
    throw OptionError(
        "option --output or option --animate is needed; see split_mapf render --help");
  }
  return wishes;
}

/// The plan as it was asked for.
Picture draw(const CommandLine& line, const Wishes& wishes, const Grid& grid,
             const CellPaths& paths, const PictureOptions& options) {
  if (wishes.at_step) return PlanFilm(grid, paths, options).at(*wishes.at_step);
  if (wishes.heat) return drawHeat(grid, paths, options);
  if (!line.has("regions")) return drawPlan(grid, paths, options);
  const std::string file = line.text("plan");
  const std::optional<Layout> layout = readPlanLayout(file, grid);
  if (!layout) {
    throw InputError(file + ": its `layout` is null: --regions needs a plan of a space split");
  }
  const auto phase = static_cast<std::uint32_t>(line.wholeNumber("phase", 0, 0, kMostPhases));
  return drawPlan(grid, paths, *layout, phase, options);
}

/// Hands the frames of a film to its writer, the last one for a second.
template <typename Writer, typename Finish>
void addFrames(const PlanFilm& film, int frames, Writer& writer, const Finish& finish) {
  const auto step = [&](int frame) { return film.lastStep() * frame / (frames - 1); };
  Picture last;
  for (int frame = 0; frame < frames; ++frame) {
    last = film.at(step(frame));
    writer.add(last);
  }
  for (int held = 0; held < kFramesPerSec; ++held) writer.add(last);
  finish();
}

/// Writes a film as GIF or, by its name, as MP4.
void writeFilm(const Wishes& wishes, const PlanFilm& film) {
  const double duration = wishes.film_duration.value_or(
      std::clamp(film.lastStep() * kFilmSecPerStep, kLeastFilmSec, kAutomaticFilmSec));
  const double wanted = std::round(duration * kFramesPerSec);
  if (wanted > kMostFrames) {
    throw OptionError("option --duration: a film of " + counted(std::llround(wanted), "frame") +
                      " is too long, at most " + std::to_string(kMostFrames) + " are expected");
  }
  const auto frames = static_cast<int>(wanted);
  const Picture last = film.at(film.lastStep());
  if (isVideo(wishes.film_file)) {
    Video video(wishes.film_file, last.width_px, last.height_px, kFramesPerSec);
    addFrames(film, frames, video, [&] { video.finish(); });
  } else {
    GifWriter gif({film.at(0), film.at(film.lastStep() / 2), last}, 100 / kFramesPerSec);
    addFrames(film, frames, gif, [&] { gif.write(wishes.film_file); });
  }
  std::cout << wishes.film_file << ": " << last.width_px << "x" << last.height_px << " pixels, "
            << std::lround(wanted / kFramesPerSec) + 1 << " s\n";
}

void writePicture(const CommandLine& line, const Picture& picture, std::size_t robots) {
  const std::string output = line.text("output");
  writePng(output, picture);
  std::cout << output << ": " << picture.width_px << "x" << picture.height_px << " pixels, "
            << counted(robots, "robot") << "\n";
}

/// Robots that have size, over their own map.
void renderDiscs(const CommandLine& line, const Wishes& wishes, std::uint32_t cell_px) {
  for (const char* name : {"regions", "heat"}) {
    if (!line.has(name)) continue;
    throw OptionError(std::string("option --") + name + " needs robots without size");
  }
  const ClaimedDiscs claimed = readClaimedDiscs(line);
  const std::vector<std::string> wrong = wrongEnds(claimed);
  if (!wrong.empty()) throw InputError("the plan is not for this scenario: " + wrong.front());
  const ObstacleRaster& raster = *claimed.files.task.raster;
  const std::vector<double>& radius_m = claimed.discs.radius_m;
  if (line.has("output")) {
    writePicture(line,
                 wishes.at_step
                     ? PlanFilm(raster, claimed.courses, radius_m, cell_px).at(*wishes.at_step)
                     : drawDiscs(raster, claimed.courses, radius_m, cell_px),
                 claimed.courses.size());
  }
  if (wishes.film_file.empty()) return;
  if (cell_px == 0) {
    cell_px = std::max(1U, kFilmSidePx / std::max(raster.width, raster.height));
  }
  writeFilm(wishes, PlanFilm(raster, claimed.courses, radius_m, cell_px));
}

void renderCells(const CommandLine& line, const Wishes& wishes, const RobotOptions& robots,
                 PictureOptions options) {
  const auto grid = readMapOfPoints(line.text("map"), robots);
  const CellPaths paths = readPlanJson(line.text("plan"));
  if (paths.empty()) throw InputError(line.text("plan") + ": its `paths` are empty: no plan");
  requireMatch(paths, readMovingAiScenario(line.text("scen"), *grid,
                                           static_cast<std::uint32_t>(paths.size())));
  if (line.has("output")) {
    writePicture(line, draw(line, wishes, *grid, paths, options), paths.size());
  }
  if (wishes.film_file.empty()) return;
  if (options.cell_px == 0) {
    options.cell_px = std::max(1U, kFilmSidePx / std::max(grid->width(), grid->height()));
  }
  writeFilm(wishes, PlanFilm(*grid, paths, options));
}

}  // namespace

ExitCode runRender(const Call& call) {
  CommandLine line("render", "Draws a plan as a PNG picture, or as an animated GIF.");
  line.require("map", "FILE", "MovingAI .map, or map_server .yaml");
  line.require("scen", "FILE", "MovingAI .scen, or .yaml with poses, that the plan is for");
  line.require("plan", "FILE", "JSON with `paths`, as `plan --output` writes it");
  line.offer("output", "FILE", "write the picture as PNG");
  line.offer("at", "STEP",
             "show where the robots are STEP steps after the start, instead of paths");
  line.offerFlag("heat", "show how often each cell is used, instead of paths");
  line.offerFlag("regions", "show the regions, buffers and intermediate states of a space split");
  line.offer("phase", "N", "with --regions: the phase to show, from 0 on (0)");
  line.offer(
      "animate", "FILE",
      "write the robots' motion as animated GIF, or as MP4 where FILE ends in .mp4 (ffmpeg)");
  line.offer("duration", "S",
             "with --animate: how long it takes (a quarter second a step, 2 to 20)");
  line.offer("scale", "PIXELS",
             "pixels a cell, 1 to 256 (so that a picture has about 1000, an animation about 500)");
  declareRobotSize(line);
  if (!line.parse(call.arguments)) return ExitCode::kOk;
  const RobotOptions robots = readRobotOptions(line);
  PictureOptions options;
  options.cell_px =
      static_cast<std::uint32_t>(line.wholeNumber("scale", options.cell_px, 1, kMostCellPx));
  const Wishes wishes = readWishes(line);
  for (const char* name : {"output", "animate"}) {
    if (line.has(name)) requireWritable(line.text(name));
  }
  if (asksForRoadmap(robots.roadmap) || isPoseScenario(line.text("scen"))) {
    renderDiscs(line, wishes, options.cell_px);
  } else {
    renderCells(line, wishes, robots, options);
  }
  return ExitCode::kOk;
}

}  // namespace split_mapf::tool
