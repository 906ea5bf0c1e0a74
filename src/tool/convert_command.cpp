#include <cstdint>
#include <iostream>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "split_mapf/core/error.h"
#include "split_mapf/io/map_file.h"
#include "split_mapf/io/map_json.h"
#include "split_mapf/io/movingai.h"
#include "split_mapf/io/pose_scenario.h"
#include "tool/command_line.h"
#include "tool/commands.h"
#include "tool/files.h"
#include "tool/vda5050_orders.h"

namespace split_mapf::tool {
namespace {

constexpr std::uint64_t kMostSide = 1U << 15;

/// Reads "24x12".
MapSize parseSize(const std::string& text) {
  const auto side = [&text](const std::string& digits) {
    const bool whole = !digits.empty() && digits.size() <= 5 &&
                       digits.find_first_not_of("0123456789") == std::string::npos;
    const std::uint64_t value = whole ? std::stoull(digits) : 0;
    if (value >= 1 && value <= kMostSide) return static_cast<std::uint32_t>(value);
    throw OptionError("option --size: '" + text + "' was given, WIDTHxHEIGHT, each 1 to " +
                      std::to_string(kMostSide) + ", is expected");
  };
  const std::size_t cross = text.find('x');
  return {side(text.substr(0, cross)),
          side(cross == std::string::npos ? "" : text.substr(cross + 1))};
}

void requireSuitable(const CommandLine& line) {
  if (line.has("map") == line.has("size")) {
    throw OptionError(
        "option --map or option --size is needed, one of both; see split_mapf convert --help");
  }
  for (const char* name : {"size", "agents"}) {
    if (line.has(name) && !line.has("scen")) {
      throw OptionError(std::string("option --") + name + " needs --scen");
    }
  }
  if (line.has("resolution") && !line.has("map")) {
    throw OptionError("option --resolution needs --map");
  }
}

OccupancyMap readChosenMap(const CommandLine& line) {
  std::optional<double> resolution_m;
  if (line.has("resolution")) resolution_m = line.number("resolution", 1, 0);
  return readOccupancyMap(line.text("map"), {}, resolution_m);
}

std::optional<std::uint32_t> agentsOf(const CommandLine& line) {
  if (!line.has("agents")) return std::nullopt;
  return static_cast<std::uint32_t>(
      line.wholeNumber("agents", 1, 1, std::numeric_limits<std::uint32_t>::max()));
}

/// What was read, and where it shall be written.
class Conversion {
 public:
  explicit Conversion(const CommandLine& line) {
    const std::optional<std::uint32_t> agents = agentsOf(line);
    const bool of_poses = line.has("scen") && isPoseScenario(line.text("scen"));
    if (of_poses) robots_ = readPoseScenario(line.text("scen"), agents);
    if (line.has("size")) {
      size_ = parseSize(line.text("size"));
      if (of_poses) return;
      scenario_ = readMovingAiScenario(line.text("scen"), size_, agents);
      return;
    }
    map_ = readChosenMap(line);
    const Grid& grid = *map_->grid;
    size_ = {grid.width(), grid.height()};
    if (line.has("scen") && !of_poses)
      scenario_ = readMovingAiScenario(line.text("scen"), grid, agents);
  }

  void write(const std::string& output) const {
    if (output == "-") {
      writeMapJson(std::cout, size_, map_, scenario_, robots_);
    } else {
      writeMapJson(output, size_, map_, scenario_, robots_);
    }
  }

 private:
  MapSize size_;
  std::optional<OccupancyMap> map_;
  std::optional<Scenario> scenario_;
  std::vector<PosedRobot> robots_;  ///< of a scenario of poses
};

}  // namespace

ExitCode runConvert(const Call& call) {
  CommandLine line("convert",
                   "Reads a map, and a scenario, as all commands do, and writes them as JSON for\n"
                   "other programs: `width`, `height`, `resolution` [m], `origin` [x, y, yaw],\n"
                   "`occupancy` (base64, a byte a cell from the top left on: 0 to 100, 255 is\n"
                   "unknown), `starts` and `goals` ([x, y], y from the top), or, of a scenario of\n"
                   "poses, `robots` (`id`, `start` and `goal` [x, y, yaw], `radius` or null).\n"
                   "With --export vda5050: a plan as orders of VDA 5050.");
  line.offer("map", "FILE", "MovingAI .map, or map_server .yaml");
  line.offer("size", "WxH",
             "instead of --map: the size of a map that is elsewhere; whether its cells are free is "
             "not asked, and what a map says is null");
  line.offer("scen", "FILE", "MovingAI .scen, or .yaml with poses of robots");
  line.offer("agents", "N", "the scenario's first N rows (all)");
  line.offer("resolution", "M", "side of a cell of a MovingAI .map in metres (1)");
  line.offer("output", "FILE", "write the JSON there; - for standard output (-)");
  offerOrderOptions(line);
  if (!line.parse(call.arguments)) return ExitCode::kOk;
  const std::string output = line.text("output", "-");
  const bool orders = asksForOrders(line);
  requireSuitable(line);
  if (output != "-") requireWritable(output);
  if (orders) {
    writeText(output, ordersOf(line, readChosenMap(line)));
    return ExitCode::kOk;
  }
  Conversion(line).write(output);
  return ExitCode::kOk;
}

}  // namespace split_mapf::tool
