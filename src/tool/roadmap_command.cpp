#include <chrono>
#include <cstdint>
#include <iomanip>
#include <iostream>
#include <locale>
#include <optional>
#include <sstream>

#include "split_mapf/core/error.h"
#include "split_mapf/io/roadmap_picture.h"
#include "split_mapf/roadmap/reach.h"
#include "split_mapf/roadmap/roadmap.h"
#include "tool/command_line.h"
#include "tool/commands.h"
#include "tool/files.h"
#include "tool/robot_options.h"
#include "tool/stop_signals.h"

namespace split_mapf::tool {
namespace {

constexpr std::uint32_t kMostCellPx = 256;

std::string describe(const Roadmap& roadmap, const Reach& reach, double seconds) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(2);
  text << "vertices: " << roadmap.cells.size() << ", edges: " << roadmap.edges.size() << "\n"
       << "spacing: " << roadmap.spacing_cells * roadmap.resolution_m
       << " m, longest edge: " << roadmap.longest_edge_m << " m\n"
       << "reach: " << 100 * reach.share() << " % of the ground on which a robot's centre fits\n"
       << "rooms: " << reach.rooms << ", lost: " << reach.rooms_lost << "\n"
       << "seconds: " << seconds << "\n";
  return text.str();
}

ObstacleRaster readObstacles(const std::string& file, const RobotOptions& options,
                             const Deadline& deadline) {
  const ReadingGuard guard(deadline.remainingSec());
  return obstaclesOf(readMapInMetres(file, options), options);
}

}  // namespace

ExitCode runRoadmap(const Call& call) {
  CommandLine line(
      "roadmap",
      "Builds the planning graph of a map for robots that have size, and says how much\n"
      "of the map it serves.");
  line.require("map", "FILE", "map_server .yaml");
  declareRobotOptions(line);
  line.offer("output", "FILE", "draw the graph over the map, as PNG");
  line.offer("scale", "PIXELS", "pixels a map cell, 1 to 256 (so that the picture has about 1500)");
  line.offer("time-limit", "SECONDS", "wall time for all of it (60)");
  if (!line.parse(call.arguments)) return ExitCode::kOk;
  const RobotOptions options = readRobotOptions(line);
  const auto cell_px = static_cast<std::uint32_t>(line.wholeNumber("scale", 0, 1, kMostCellPx));
  const std::string output = line.text("output", "");
  if (!output.empty()) requireWritable(output);
  const Deadline deadline(line.number("time-limit", 60, 0), catchStopSignals());
  const ObstacleRaster raster = readObstacles(line.text("map"), options, deadline);
  const auto begin = Deadline::Clock::now();
  const std::optional<Roadmap> roadmap = buildRoadmap(raster, options.roadmap, deadline);
  const std::chrono::duration<double> built = Deadline::Clock::now() - begin;
  std::optional<Reach> reach;
  if (roadmap) reach = measureReach(raster, *roadmap, options.snap_distance_m, deadline);
  if (!reach) {
    const bool cancelled = deadline.stopRequested();
    std::cerr << "split_mapf: " << (cancelled ? "cancelled" : "timeout")
              << ": before the planning graph was done\n";
    return cancelled ? ExitCode::kCancelled : ExitCode::kTimeout;
  }
  if (!output.empty()) writePng(output, drawRoadmap(*roadmap, *reach, cell_px));
  std::cout << describe(*roadmap, *reach, built.count());
  return ExitCode::kOk;
}

}  // namespace split_mapf::tool
