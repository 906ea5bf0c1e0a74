#include "split_mapf/io/pose_scenario.h"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <filesystem>
#include <iomanip>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "io/file_bytes.h"
#include "io/line_reader.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

constexpr const char* kShape = "robots: [{id, start: [x, y, yaw], goal: [x, y, yaw]}, ...]";

class PoseReader {
 public:
  explicit PoseReader(const std::string& path) : path_(path) {
    try {
      root_ = YAML::Load(readFile(path));
    } catch (const YAML::Exception& error) {
      failAt(error.mark, "read malformed YAML (" + error.msg + "), expected " + kShape);
    }
  }

  std::vector<PosedRobot> read(std::optional<std::uint32_t> agents) {
    if (!root_.IsMap() || root_.size() != 1 || !root_["robots"]) {
      failAt(root_.Mark(), std::string("read something else, expected ") + kShape);
    }
    const YAML::Node list = root_["robots"];
    if (!list.IsSequence() || list.size() == 0) {
      failAt(list.Mark(), std::string("robots: read no robots, expected ") + kShape);
    }
    std::vector<PosedRobot> robots;
    for (const YAML::Node& node : list) {
      if (agents && robots.size() == *agents) return robots;
      robots.push_back(readRobot(node));
    }
    if (agents && robots.size() < *agents) {
      failAt(list.Mark(), "robots: read " + counted(robots.size(), "robot") + ", expected " +
                              counted(*agents, "robot"));
    }
    return robots;
  }

 private:
  [[noreturn]] void failAt(const YAML::Mark& mark, const std::string& message) const {
    failAtLine(path_, mark.line < 0 ? 1 : static_cast<std::size_t>(mark.line) + 1, message);
  }

  static std::string textOf(const YAML::Node& node) {
    return node.IsScalar() ? quote(node.Scalar()) : "no single value";
  }

  PosedRobot readRobot(const YAML::Node& node) {
    if (!node.IsMap()) failAt(node.Mark(), std::string("read no robot, expected ") + kShape);
    std::set<std::string> keys;
    for (const auto& pair : node) {
      const std::string key = pair.first.IsScalar() ? pair.first.Scalar() : "";
      if (key != "id" && key != "start" && key != "goal" && key != "radius") {
        failAt(pair.first.Mark(),
               "read the key " + quote(key) + ", expected id, start, goal or radius");
      }
      if (!keys.insert(key).second) {
        failAt(pair.first.Mark(),
               "read the key " + quote(key) + " a second time, expected it once");
      }
    }
    PosedRobot robot;
    robot.id = readId(node);
    robot.start = readPose(node, robot.id, "start");
    robot.goal = readPose(node, robot.id, "goal");
    if (node["radius"]) {
      const double radius = numberOf(node["radius"], robot.id, "radius");
      if (radius < 0) {
        failAt(node["radius"].Mark(), "robot " + quote(robot.id) + ": radius: read " +
                                          textOf(node["radius"]) + ", expected 0 or more [m]");
      }
      robot.radius_m = radius;
    }
    return robot;
  }

  std::string readId(const YAML::Node& node) {
    const YAML::Node id = node["id"];
    if (!id) failAt(node.Mark(), "read a robot without the key 'id', expected its name");
    if (!id.IsScalar() || id.Scalar().empty()) {
      failAt(id.Mark(), "id: read " + textOf(id) + ", expected a name");
    }
    const int line = id.Mark().line + 1;
    const auto [first, is_new] = lines_.emplace(id.Scalar(), line);
    if (!is_new) {
      failAt(id.Mark(), "read the id " + quote(id.Scalar()) + " a second time (first in line " +
                            std::to_string(first->second) + "), expected every id once");
    }
    return id.Scalar();
  }

  MapPose readPose(const YAML::Node& robot, const std::string& id, const char* key) const {
    const YAML::Node node = robot[key];
    const std::string where = "robot " + quote(id) + ": " + key;
    if (!node) failAt(robot.Mark(), where + " is missing, expected [x, y, yaw]");
    if (!node.IsSequence() || node.size() != 3) {
      failAt(node.Mark(), where + ": read no list of three, expected [x, y, yaw]");
    }
    return {numberOf(node[0], id, key), numberOf(node[1], id, key), numberOf(node[2], id, key)};
  }

  double numberOf(const YAML::Node& node, const std::string& id, const char* key) const {
    double value = NAN;
    if (node.IsScalar() && YAML::convert<double>::decode(node, value) && std::isfinite(value)) {
      return value;
    }
    failAt(node.Mark(), "robot " + quote(id) + ": " + key + ": read " + textOf(node) +
                            ", expected a finite number");
  }

  const std::string& path_;
  YAML::Node root_;
  std::map<std::string, int> lines_;  // of the ids
};

/// A name that YAML does not take for anything else.
std::string quoted(const std::string& id) {
  YAML::Emitter out;
  out << YAML::DoubleQuoted << id;
  return out.c_str();
}

std::string textOf(const MapPose& pose) {
  std::ostringstream text;
  text << std::setprecision(std::numeric_limits<double>::max_digits10);
  text << "[" << pose.x_m << ", " << pose.y_m << ", " << pose.yaw_rad << "]";
  return text.str();
}

}  // namespace

bool isPoseScenario(const std::string& path) {
  const std::string extension = lowerCase(std::filesystem::path(path).extension().string());
  return extension == ".yaml" || extension == ".yml";
}

std::vector<PosedRobot> readPoseScenario(const std::string& path,
                                         std::optional<std::uint32_t> agents) {
  return PoseReader(path).read(agents);
}

void writePoseScenario(const std::string& path, const std::vector<PosedRobot>& robots,
                       const std::string& comment) {
  std::ostringstream out;
  out << "# " << comment << "\nrobots:\n";
  for (const PosedRobot& robot : robots) {
    out << "- {id: " << quoted(robot.id) << ", start: " << textOf(robot.start)
        << ", goal: " << textOf(robot.goal);
    if (robot.radius_m) {
      out << ", radius: " << std::setprecision(std::numeric_limits<double>::max_digits10)
          << *robot.radius_m;
    }
    out << "}\n";
  }
  writeFile(path, wholeText(out));
}

}  // namespace split_mapf
