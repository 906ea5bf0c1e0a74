#include "split_mapf/io/map_file.h"

#include <cmath>
#include <filesystem>

#include "io/line_reader.h"
#include "split_mapf/core/error.h"
#include "split_mapf/io/movingai.h"

namespace split_mapf {
namespace {

constexpr std::int8_t kFree = 0;
constexpr std::int8_t kOccupied = 100;

}  // namespace

bool isMapServerFile(const std::string& path) {
  const std::string extension = lowerCase(std::filesystem::path(path).extension().string());
  if (extension == ".yaml" || extension == ".yml") return true;
  if (extension == ".map") return false;
  throw InputError(path + ": cannot tell the form of this map, expected a MovingAI .map or a " +
                   "map_server .yaml");
}

std::shared_ptr<const Grid> readMap(const std::string& path, const OccupancyRule& rule) {
  return isMapServerFile(path) ? readMapServerMap(path, rule).grid : readMovingAiMap(path);
}

OccupancyMap readOccupancyMap(const std::string& path, const OccupancyRule& rule,
                              std::optional<double> resolution_m) {
  if (isMapServerFile(path)) {
    if (resolution_m) {
      throw OptionError("a resolution was given for " + path +
                        ", expected none: the file says its own");
    }
    return readMapServerMap(path, rule);
  }
  OccupancyMap map;
  map.resolution_m = resolution_m.value_or(1);
  if (!std::isfinite(map.resolution_m) || map.resolution_m <= 0) {
    throw OptionError("the resolution is " + std::to_string(map.resolution_m) +
                      ", expected a finite number above 0 [m]");
  }
  map.grid = readMovingAiMap(path);
  map.occupancy.assign(std::size_t{map.grid->width()} * map.grid->height(), kOccupied);
  for (Vertex v = 0; v < map.grid->size(); ++v) {
    const Cell cell = map.grid->cellOf(v);
    map.occupancy[static_cast<std::size_t>(cell.y) * map.grid->width() +
                  static_cast<std::size_t>(cell.x)] = kFree;
  }
  return map;
}

}  // namespace split_mapf
