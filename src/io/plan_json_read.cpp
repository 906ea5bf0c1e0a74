#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "io/file_bytes.h"
#include "io/json_text.h"
#include "io/streamed_json.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/io/plan_json.h"

namespace split_mapf {
namespace {

using Json = nlohmann::json;

[[noreturn]] void fail(const std::string& path, const std::string& message) {
  throw InputError(path + ": " + message);
}

// A JSON value as a message shows it, cut where it is long.
std::string shown(const Json& value) { return quote(asciiJson(value)); }

// Strips what nlohmann-json puts before the reason: "[json.exception...] parse error at ...: ".
std::string reasonOf(const Json::parse_error& error) {
  const std::string text = error.what();
  const std::size_t colon = text.find(": ");
  return colon == std::string::npos ? text : text.substr(colon + 2);
}

// "... number overflow parsing '1e999'": what stands between the quotes.
std::string numberOf(const Json::out_of_range& error) {
  const std::string text = error.what();
  const std::size_t begin = text.find('\'') + 1;
  return text.substr(begin, text.rfind('\'') - begin);
}

// One plan file being read: its name, and the place that a message names.
struct Place {
  const std::string& path;
  std::size_t robot = 0;
  std::size_t step = 0;

  [[noreturn]] void failAtStep(const std::string& message) const {
    fail(path, "paths, robot " + std::to_string(robot) + ", step " + std::to_string(step) + ": " +
                   message);
  }
};

std::int32_t coordinateOf(const Json& value, const Place& place, const char* axis) {
  using Limits = std::numeric_limits<std::int32_t>;
  const bool fits = value.is_number_unsigned()
                        ? value.get<std::uint64_t>() <= static_cast<std::uint64_t>(Limits::max())
                        : value.is_number_integer() && value.get<std::int64_t>() >= Limits::min();
  if (!fits) {
    place.failAtStep(std::string("read ") + axis + " = " + shown(value) +
                     ", expected a 32-bit integer");
  }
  return value.get<std::int32_t>();
}

Cell cellOf(const Json& value, const Place& place) {
  if (!value.is_array() || value.size() != 2) {
    place.failAtStep("read " + shown(value) + ", expected [x,y]");
  }
  return {coordinateOf(value[0], place, "x"), coordinateOf(value[1], place, "y")};
}

double lengthOf(const Json& value, const std::string& path, const std::string& what) {
  if (!value.is_number() || !(value.get<double>() >= 0)) {
    fail(path, what + ": read " + shown(value) + ", expected a number of 0 or more");
  }
  return value.get<double>();
}

double lengthAt(const std::string& path, const Json& document, const char* key) {
  const auto value = document.find(key);
  return value == document.end() ? 0 : lengthOf(*value, path, key);
}

std::vector<double> radiiOf(const std::string& path, const Json& document, std::size_t robots) {
  const auto list = document.find("radii");
  if (list == document.end()) return {};
  if (!list->is_array()) fail(path, "radii: read " + shown(*list) + ", expected a list of numbers");
  if (list->size() != robots) {
    fail(path, "radii: read " + counted(list->size(), "number") + ", expected " +
                   std::to_string(robots) + ", as many as there are robots in 'poses'");
  }
  std::vector<double> radii;
  for (const Json& value : *list) {
    radii.push_back(lengthOf(value, path, "radii, robot " + std::to_string(radii.size())));
  }
  return radii;
}

MapPoint pointOf(const Json& value, const std::string& path, std::size_t robot, std::size_t step) {
  if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number()) {
    fail(path, "poses, robot " + std::to_string(robot) + ", step " + std::to_string(step) +
                   ": read " + shown(value) + ", expected [x, y]");
  }
  return {value[0].get<double>(), value[1].get<double>()};
}

constexpr std::uint64_t kMostSteps = std::uint64_t{1} << 24U;
// A short file must not ask for all memory: cells of all its compact paths, and more for each byte.
constexpr std::uint64_t kCellsOfAnyFile = std::uint64_t{1} << 20U;
constexpr std::uint64_t kCellsAByte = 1024;

/// Reads from the front of a text.
class CompactReader {
 public:
  explicit CompactReader(const std::string& text) : text_(text) {}

  bool atEnd() const { return at_ == text_.size(); }
  char take() { return text_[at_++]; }
  bool isDigit() const { return !atEnd() && text_[at_] >= '0' && text_[at_] <= '9'; }
  void expect(char wanted, const char* what) {
    if (atEnd() || take() != wanted) fail(what);
  }
  std::uint64_t number(std::uint64_t most, const char* what) {
    if (!isDigit()) fail(what);
    std::uint64_t value = 0;
    while (isDigit()) {
      value = 10 * value + static_cast<std::uint64_t>(take() - '0');
      if (value > most) fail(what);
    }
    return value;
  }
  [[noreturn]] void fail(const char* what) const {
    throw std::invalid_argument("read " + quote(text_) + ", expected " + what);
  }

 private:
  const std::string& text_;
  std::size_t at_ = 0;
};

constexpr const char* kFirstCell = "a path like \"12,3 4R2DWU\": first x,y within the map";
constexpr const char* kMoves = "a path like \"12,3 4R2DWU\": runs of R, L, U, D and W";

Cell readFirstCell(CompactReader& reader) {
  constexpr std::uint64_t kMostCoordinate = 0x7fffffffU - kMostSteps;
  Cell cell{};
  cell.x = static_cast<std::int32_t>(reader.number(kMostCoordinate, kFirstCell));
  reader.expect(',', kFirstCell);
  cell.y = static_cast<std::int32_t>(reader.number(kMostCoordinate, kFirstCell));
  return cell;
}

Cell readMove(CompactReader& reader) {
  switch (reader.take()) {
    case 'R':
      return {1, 0};
    case 'L':
      return {-1, 0};
    case 'D':
      return {0, 1};
    case 'U':
      return {0, -1};
    case 'W':
      return {0, 0};
    default:
      reader.fail(kMoves);
  }
}

/// See PathForm::kCompact. @param most  cells that it may have.
std::vector<Cell> cellsOfCompactPath(const std::string& text, std::uint64_t most) {
  if (text.empty()) return {};
  CompactReader reader(text);
  Cell at = readFirstCell(reader);
  std::vector<Cell> cells = {at};
  if (reader.atEnd()) return cells;
  reader.expect(' ', kMoves);
  if (reader.atEnd()) reader.fail(kMoves);
  while (!reader.atEnd()) {
    const std::uint64_t run = reader.isDigit() ? reader.number(kMostSteps, kMoves) : 1;
    if (run == 0 || reader.atEnd() || cells.size() + run > kMostSteps) reader.fail(kMoves);
    if (cells.size() + run > most) reader.fail("fewer steps, in so short a file");
    const Cell move = readMove(reader);
    for (std::uint64_t i = 0; i < run; ++i) {
      at = {at.x + move.x, at.y + move.y};
      cells.push_back(at);
    }
  }
  return cells;
}

std::vector<Cell> compactCellsOf(const std::string& text, const std::string& path,
                                 std::size_t robot, std::uint64_t most) {
  try {
    return cellsOfCompactPath(text, most);
  } catch (const std::invalid_argument& error) {
    fail(path, "paths, robot " + std::to_string(robot) + ": " + error.what());
  }
}

/// Takes the paths one by one, as they are read.
class PathTaker {
 public:
  explicit PathTaker(const std::string& path) : path_(path) {}

  void take(const Json& list) {
    const std::size_t robot = paths_.size();
    if (list.is_string()) {
      const auto& text = list.get_ref<const std::string&>();
      room_ += kCellsAByte * text.size();
      paths_.push_back(compactCellsOf(text, path_, robot, room_));
      room_ -= paths_.back().size();
      return;
    }
    if (!list.is_array()) {
      fail(path_, "paths, robot " + std::to_string(robot) + ": read " + shown(list) +
                      ", expected a list of cells");
    }
    std::vector<Cell>& cells = paths_.emplace_back();
    cells.reserve(list.size());
    for (const Json& cell : list) cells.push_back(cellOf(cell, {path_, robot, cells.size()}));
  }
  CellPaths& paths() { return paths_; }

 private:
  const std::string& path_;
  CellPaths paths_;
  std::uint64_t room_ = kCellsOfAnyFile;
};

/// Takes the poses likewise.
class PoseTaker {
 public:
  explicit PoseTaker(const std::string& path) : path_(path) {}

  void take(const Json& list) {
    const std::size_t robot = poses_.size();
    if (!list.is_array()) {
      fail(path_, "poses, robot " + std::to_string(robot) + ": read " + shown(list) +
                      ", expected a list of points");
    }
    std::vector<MapPoint>& poses = poses_.emplace_back();
    poses.reserve(list.size());
    for (const Json& point : list) poses.push_back(pointOf(point, path_, robot, poses.size()));
  }
  std::vector<std::vector<MapPoint>>& poses() { return poses_; }

 private:
  const std::string& path_;
  std::vector<std::vector<MapPoint>> poses_;
};

/// @param offset  of the byte that is wrong; beyond the end: the last line.
[[noreturn]] void failAtLineOf(const std::string& path, const std::string& bytes,
                               std::size_t offset, const std::string& message) {
  const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), offset));
  const auto lines = std::count(bytes.begin(), end, '\n');
  failAtLine(path, static_cast<std::size_t>(lines) + 1, message);
}

/// @param paths  the list of them.
Json parse(const std::string& path, StreamedObject parser, const StreamedList& paths) {
  const std::string bytes = readFile(path);
  Json document;
  try {
    document = parser.parse(bytes);
  } catch (const Json::parse_error& error) {
    failAtLineOf(path, bytes, error.byte > 0 ? error.byte - 1 : 0,
                 "read malformed JSON, expected a plan: " + reasonOf(error));
  } catch (const Json::out_of_range& error) {
    // The library tells the number, but not where it stands.
    const std::string number = numberOf(error);
    failAtLineOf(path, bytes, bytes.find(number),
                 "read " + quote(number) + ", expected a number below 1.8e308");
  }
  if (!document.is_object()) fail(path, "read " + shown(document) + ", expected a JSON object");
  if (paths.times == 0) fail(path, "read no 'paths', expected a list of paths, one a robot");
  if (paths.times > 1) fail(path, "read 'paths' a second time, expected it once");
  return document;
}

void requireListOfPaths(const std::string& path, const Json& document) {
  const Json& value = document.at("paths");
  if (!value.is_array()) fail(path, "paths: read " + shown(value) + ", expected a list of paths");
}

}  // namespace

DiscClaims readDiscPlanJson(const std::string& path) {
  PathTaker paths(path);
  PoseTaker poses(path);
  StreamedList path_list{"paths", [&](const Json& list) { paths.take(list); }};
  StreamedList pose_list{"poses", [&](const Json& list) { poses.take(list); }};
  const Json document =
      parse(path, StreamedObject({&path_list, &pose_list}, {"robot_radius", "clearance", "radii"}),
            path_list);
  DiscClaims claims;
  claims.robot_radius_m = lengthAt(path, document, "robot_radius");
  claims.clearance_m = lengthAt(path, document, "clearance");
  const auto lists = document.find("poses");
  if (lists == document.end() || !lists->is_array()) {
    fail(path, "read no list 'poses', expected the plan of robots that have size");
  }
  if (pose_list.times > 1) fail(path, "read 'poses' a second time, expected it once");
  pose_list.requireSound();
  claims.poses = std::move(poses.poses());
  claims.radius_m = radiiOf(path, document, claims.poses.size());
  requireListOfPaths(path, document);
  path_list.requireSound();
  claims.paths = std::move(paths.paths());
  return claims;
}

CellPaths readPlanJson(const std::string& path) {
  PathTaker paths(path);
  StreamedList path_list{"paths", [&](const Json& list) { paths.take(list); }};
  StreamedList pose_list{"poses", [](const Json&) {}};
  const Json document = parse(path, StreamedObject({&path_list, &pose_list}, {}), path_list);
  const auto poses = document.find("poses");
  if (pose_list.entries > 0 || (poses != document.end() && !poses->empty())) {
    fail(path,
         "read a plan of robots that have size, expected one of cells (validate, render and "
         "simulate take both: with --robot-radius, --cell-size or a scenario of poses)");
  }
  requireListOfPaths(path, document);
  path_list.requireSound();
  return std::move(paths.paths());
}

}  // namespace split_mapf
