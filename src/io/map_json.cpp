#include "split_mapf/io/map_json.h"

#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>
#include <vector>

#include "io/file_bytes.h"
#include "io/json_text.h"

namespace split_mapf {
namespace {

// RFC 4648, with padding.
std::string base64Of(const std::vector<std::int8_t>& values) {
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto byte_at = [&values](std::size_t i) {
    return i < values.size() ? std::uint32_t{static_cast<std::uint8_t>(values[i])} : 0U;
  };
  std::string text;
  text.reserve((values.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < values.size(); i += 3) {
    const std::uint32_t group = byte_at(i) << 16U | byte_at(i + 1) << 8U | byte_at(i + 2);
    text += kDigits[group >> 18U];
    text += kDigits[group >> 12U & 63U];
    text += i + 1 < values.size() ? kDigits[group >> 6U & 63U] : '=';
    text += i + 2 < values.size() ? kDigits[group & 63U] : '=';
  }
  return text;
}

std::string cellsText(const std::vector<Cell>& cells) {
  std::string text = "[";
  for (const Cell cell : cells) {
    if (text.size() > 1) text += ',';
    text += "[" + std::to_string(cell.x) + "," + std::to_string(cell.y) + "]";
  }
  return text + "]";
}

nlohmann::json poseJson(const MapPose& pose) {
  return nlohmann::json::array({pose.x_m, pose.y_m, pose.yaw_rad});
}

std::string robotsText(const std::vector<PosedRobot>& robots) {
  nlohmann::json list = nlohmann::json::array();
  for (const PosedRobot& robot : robots) {
    nlohmann::json radius;
    if (robot.radius_m) radius = *robot.radius_m;
    list.push_back({{"id", robot.id},
                    {"start", poseJson(robot.start)},
                    {"goal", poseJson(robot.goal)},
                    {"radius", radius}});
  }
  return asciiJson(list);
}

}  // namespace

void writeMapJson(std::ostream& out, MapSize size, const std::optional<OccupancyMap>& map,
                  const std::optional<Scenario>& scenario, const std::vector<PosedRobot>& robots) {
  using Json = nlohmann::json;
  const Json resolution = map ? Json(map->resolution_m) : Json(nullptr);
  const Json origin =
      map ? Json{map->origin.x_m, map->origin.y_m, map->origin.yaw_rad} : Json(nullptr);
  out << "{\n  \"width\": " << std::to_string(size.width)
      << ",\n  \"height\": " << std::to_string(size.height)
      << ",\n  \"resolution\": " << resolution.dump() << ",\n  \"origin\": " << origin.dump()
      << ",\n  \"occupancy\": " << (map ? '"' + base64Of(map->occupancy) + '"' : "null")
      << ",\n  \"starts\": " << (scenario ? cellsText(scenario->starts) : "null")
      << ",\n  \"goals\": " << (scenario ? cellsText(scenario->goals) : "null");
  if (!robots.empty()) out << ",\n  \"robots\": " << robotsText(robots);
  out << "\n}\n";
}

void writeMapJson(const std::string& path, MapSize size, const std::optional<OccupancyMap>& map,
                  const std::optional<Scenario>& scenario, const std::vector<PosedRobot>& robots) {
  std::ostringstream out;
  writeMapJson(out, size, map, scenario, robots);
  writeFile(path, wholeText(out));
}

}  // namespace split_mapf
