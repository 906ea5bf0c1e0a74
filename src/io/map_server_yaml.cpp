#include "io/map_server_yaml.h"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <set>

#include "io/file_bytes.h"
#include "io/line_reader.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

// The keys of one map_server YAML file.
class YamlReader {
 public:
  explicit YamlReader(const std::string& path) : path_(path) {
    try {
      root_ = YAML::Load(readFile(path));
    } catch (const YAML::Exception& error) {
      failAt(error.mark, "read malformed YAML (" + error.msg + "), expected a map_server file");
    }
    if (!root_.IsMap()) {
      failAt(root_.Mark(), "read no 'key: value' pairs, expected a map_server file");
    }
    requireDistinctKeys();
  }

  MapServerYaml read() const {
    MapServerYaml yaml;
    yaml.image = scalar("image", "a path");
    yaml.resolution_m = number("resolution");
    if (yaml.resolution_m <= 0) refuse("resolution", "a number above 0");
    yaml.origin = origin();
    yaml.negate = negate();
    yaml.occupied_thresh = share("occupied_thresh");
    yaml.free_thresh = share("free_thresh");
    if (yaml.free_thresh > yaml.occupied_thresh) {
      refuse("free_thresh", "at most occupied_thresh, " + scalar("occupied_thresh", "a number"));
    }
    yaml.mode = mode();
    return yaml;
  }

 private:
  [[noreturn]] void failAt(const YAML::Mark& mark, const std::string& message) const {
    failAtLine(path_, mark.line < 0 ? 1 : static_cast<std::size_t>(mark.line) + 1, message);
  }

  // Where the key stands: an empty value has no place of its own.
  YAML::Mark markOf(const std::string& key) const {
    for (const auto& pair : root_) {
      if (pair.first.IsScalar() && pair.first.Scalar() == key) return pair.first.Mark();
    }
    return root_.Mark();
  }

  [[noreturn]] void refuse(const std::string& key, const std::string& expected) const {
    const YAML::Node node = root_[key];
    const std::string read = node.IsScalar() ? quote(node.Scalar()) : "no single value";
    failAt(markOf(key), key + ": read " + read + ", expected " + expected);
  }

  // yaml-cpp takes the first of two equal keys in silence.
  void requireDistinctKeys() const {
    std::set<std::string> seen;
    for (const auto& pair : root_) {
      if (pair.first.IsScalar() && !seen.insert(pair.first.Scalar()).second) {
        failAt(pair.first.Mark(),
               "read the key " + quote(pair.first.Scalar()) + " a second time, expected it once");
      }
    }
  }

  YAML::Node required(const std::string& key, const std::string& expected) const {
    const YAML::Node node = root_[key];
    if (!node) failAt(root_.Mark(), "read no key " + quote(key) + ", expected it with " + expected);
    return node;
  }

  std::string scalar(const std::string& key, const std::string& expected) const {
    const YAML::Node node = required(key, expected);
    if (!node.IsScalar() || node.Scalar().empty()) refuse(key, expected);
    return node.Scalar();
  }

  double number(const std::string& key) const {
    const YAML::Node node = required(key, "a number");
    double value = NAN;
    if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value)) {
      refuse(key, "a finite number");
    }
    return value;
  }

  double share(const std::string& key) const {
    const double value = number(key);
    if (value < 0 || value > 1) refuse(key, "a number from 0 to 1");
    return value;
  }

  MapOrigin origin() const {
    const YAML::Node node = required("origin", "[x, y, yaw]");
    const std::string expected = "[x, y, yaw], three finite numbers";
    if (!node.IsSequence() || node.size() != 3) {
      failAt(markOf("origin"), "origin: read no list of three, expected " + expected);
    }
    double values[3] = {};
    for (std::size_t i = 0; i < 3; ++i) {
      const YAML::Node entry = node[i];
      const bool good = entry.IsScalar() && YAML::convert<double>::decode(entry, values[i]);
      if (!good || !std::isfinite(values[i])) {
        std::string message = "origin: read ";
        message += entry.IsScalar() ? quote(entry.Scalar()) : "no single value";
        failAt(entry.Mark(), message += ", expected " + expected);
      }
    }
    return {values[0], values[1], values[2]};
  }

  // map_server itself reads a number here, later ones a truth value of YAML.
  bool negate() const {
    const std::string expected = "0 or 1, or false or true";
    const std::string text = lowerCase(scalar("negate", expected));
    for (const char* word : {"1", "true", "yes", "on", "y"}) {
      if (text == word) return true;
    }
    for (const char* word : {"0", "false", "no", "off", "n"}) {
      if (text == word) return false;
    }
    refuse("negate", expected);
  }

  MapMode mode() const {
    const std::string expected = "trinary, scale or raw";
    if (!root_["mode"]) return MapMode::kTrinary;
    const std::string text = lowerCase(scalar("mode", expected));
    if (text == "scale") return MapMode::kScale;
    if (text == "raw") return MapMode::kRaw;
    if (text != "trinary") refuse("mode", expected);
    return MapMode::kTrinary;
  }

  const std::string path_;
  YAML::Node root_;
};

}  // namespace

MapServerYaml readMapServerYaml(const std::string& path) { return YamlReader(path).read(); }

}  // namespace split_mapf
