#include "split_mapf/io/map_server.h"

#include <cmath>
#include <filesystem>

#include "io/file_bytes.h"
#include "io/map_picture.h"
#include "io/map_server_yaml.h"
#include "io/png_structure.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

constexpr std::int8_t kFree = 0;
constexpr std::int8_t kOccupied = 100;

MapPicture readPicture(const std::string& path) {
  const std::string bytes = readFile(path);
  if (isPng(bytes)) return parsePng(path, bytes);
  if (isPnm(bytes)) return parsePnm(path, bytes);
  failAtByte(path, 0,
             "read " + (bytes.empty() ? "an empty file" : quote(bytes.substr(0, 8))) +
                 ", expected a PNG picture or a PGM, PBM or PPM picture (P1 to P6)");
}

// The brightness that map_server goes by. It averages alpha in like a colour in trinary mode.
double brightnessOf(const MapPicture& picture, std::size_t i, const MapServerYaml& yaml) {
  double brightness = picture.brightness[i];
  if (yaml.mode == MapMode::kTrinary && !picture.alpha.empty()) {
    brightness = (3 * brightness + picture.alpha[i]) / 4;
  }
  return yaml.negate ? 255 - brightness : brightness;
}

std::int8_t valueOf(const MapPicture& picture, std::size_t i, const MapServerYaml& yaml) {
  const double brightness = brightnessOf(picture, i, yaml);
  if (yaml.mode == MapMode::kRaw) {
    const auto value = std::lround(brightness);
    return value <= kOccupied ? static_cast<std::int8_t>(value) : kUnknownOccupancy;
  }
  const bool transparent = !picture.alpha.empty() && picture.alpha[i] < 254.999F;
  if (yaml.mode == MapMode::kScale && transparent) return kUnknownOccupancy;
  const double occupied = (255 - brightness) / 255;
  if (occupied > yaml.occupied_thresh) return kOccupied;
  if (occupied < yaml.free_thresh) return kFree;
  if (yaml.mode == MapMode::kTrinary) return kUnknownOccupancy;
  const double span = yaml.occupied_thresh - yaml.free_thresh;
  const double share = span > 0 ? (occupied - yaml.free_thresh) / span : 0;
  return static_cast<std::int8_t>(1 + 98 * share);
}

}  // namespace

OccupancyMap readMapServerMap(const std::string& yaml_path, const OccupancyRule& rule) {
  const MapServerYaml yaml = readMapServerYaml(yaml_path);
  const std::filesystem::path folder = std::filesystem::path(yaml_path).parent_path();
  const MapPicture picture = readPicture((folder / yaml.image).string());
  OccupancyMap map;
  map.occupancy.reserve(picture.brightness.size());
  for (std::size_t i = 0; i < picture.brightness.size(); ++i) {
    map.occupancy.push_back(valueOf(picture, i, yaml));
  }
  map.grid = std::make_shared<Grid>(picture.width, picture.height, freeCells(map.occupancy, rule));
  map.resolution_m = yaml.resolution_m;
  map.origin = yaml.origin;
  return map;
}

}  // namespace split_mapf
