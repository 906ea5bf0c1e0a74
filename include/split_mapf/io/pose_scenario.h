#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace split_mapf {

/// A pose in a map's frame.
struct MapPose {
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
};

/// One robot of a scenario of poses.
struct PosedRobot {
  std::string id;
  MapPose start;
  MapPose goal;
  std::optional<double> radius_m;  ///< its own, where it has one
};

/// Whether a scenario file is one of poses, by its name: .yaml or .yml, in any case.
bool isPoseScenario(const std::string& path);

/// Reads robots that stand anywhere, the first `agents` of them or all:
///   robots:
///   - {id: r1, start: [x, y, yaw], goal: [x, y, yaw], radius: 0.3}
/// in metres and radians of the map's frame; `radius` may be missing, anything else may not.
/// @throws InputError "path:line: ..." for malformed YAML, a key that is missing, unknown or there
/// twice, an id that is there twice, a number that is not finite, a negative radius, no robots, and
/// fewer than `agents`.
std::vector<PosedRobot> readPoseScenario(const std::string& path,
                                         std::optional<std::uint32_t> agents = std::nullopt);

/// Writes such a file; what is read from it again is the same to the last bit. @param comment  a
/// line for people. @throws InputError when the file cannot be written.
void writePoseScenario(const std::string& path, const std::vector<PosedRobot>& robots,
                       const std::string& comment);

}  // namespace split_mapf
