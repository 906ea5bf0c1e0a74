#include "split_mapf/io/execution_file.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <utility>

#include <boost/algorithm/hex.hpp>
#include <nlohmann/json.hpp>

#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

using nlohmann::json;

// What is set aside for them; more is no harm.
constexpr std::size_t kBytesPerVisit = 12;
constexpr std::size_t kBytesPerRobot = 200;
constexpr std::size_t kMostDigits = 10;  // of a number of 32 bits
constexpr const char* kFormat = "split_mapf execution 4";

void append(std::string& text, std::uint32_t number) {
  std::array<char, kMostDigits> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  text.append(digits.data(), end.ptr);
}

void append(std::string& text, const char* key, std::uint32_t number) {
  text += key;
  append(text, number);
}

/// A list of one number a visit.
template <typename NumberOf>
void append(std::string& text, const char* key, const FleetSnapshot::Robot& robot,
            NumberOf number_of) {
  text += key;
  const std::size_t begin = text.size();
  // Each with a comma.
  text.resize(begin + (kMostDigits + 1) * robot.visits.size());
  char* end = text.data() + begin;
  for (const FleetSnapshot::Visit& visit : robot.visits) {
    end = std::to_chars(end, end + kMostDigits, number_of(visit)).ptr;
    *end++ = ',';
  }
  text.resize(static_cast<std::size_t>(end - text.data()));
  if (!robot.visits.empty()) text.pop_back();
  text += ']';
}

/// Numbers of visits that follow each other as the first one and how many.
void appendSequences(std::string& text, const FleetSnapshot::Robot& robot) {
  text += ",\"sequences\":[";
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < robot.visits.size(); ++i) {
    const std::uint32_t sequence = robot.visits[i].sequence;
    if (count == 0) append(text, "[", sequence);
    ++count;
    const bool goes_on =
        i + 1 < robot.visits.size() && robot.visits[i + 1].sequence == sequence + 1;
    if (goes_on) continue;
    append(text, ",", count);
    text += "],";
    count = 0;
  }
  if (!robot.visits.empty()) text.pop_back();
  text += ']';
}

/// By hand: a value of the JSON library for each number takes ten times as long, and robots'
/// reports wait meanwhile.
void append(std::string& text, const FleetSnapshot::Robot& robot, std::uint32_t width) {
  const auto index_of = [width](Cell cell) {
    return static_cast<std::uint32_t>(cell.y) * width + static_cast<std::uint32_t>(cell.x);
  };
  text += "{\"id\":" + json(robot.id).dump();
  append(text, ",\"goal\":", index_of(robot.goal));
  text += ",\"planned\":" + json(robot.planned_sec).dump();
  text += robot.paused ? ",\"paused\":true" : ",\"paused\":false";
  append(text, ",\"next_sequence\":", robot.next_sequence);
  if (robot.held_at) append(text, ",\"held_at\":", *robot.held_at);
  appendSequences(text, robot);
  append(text, ",\"cells\":[", robot,
         [&](const FleetSnapshot::Visit& visit) { return index_of(visit.cell); });
  append(text, ",\"steps\":[", robot, [](const FleetSnapshot::Visit& visit) { return visit.step; });
  text += '}';
}

Cell cellOf(const json& pair) { return {pair.at(0).get<int>(), pair.at(1).get<int>()}; }

/// @throws InputError for a number that is no index of a grid of that width.
Cell cellOf(std::uint32_t index, std::uint32_t width) {
  constexpr std::uint32_t kMostRows = 1U << 30U;
  if (width == 0 || index / width >= kMostRows || width >= kMostRows) {
    throw InputError("it has a cell " + std::to_string(index) + " that is none");
  }
  return {static_cast<std::int32_t>(index % width), static_cast<std::int32_t>(index / width)};
}

FleetSnapshot::Robot robotOf(const json& from, std::uint32_t width) {
  FleetSnapshot::Robot robot;
  robot.id = from.at("id").get<std::string>();
  robot.goal = cellOf(from.at("goal").get<std::uint32_t>(), width);
  robot.planned_sec = from.at("planned").get<double>();
  robot.paused = from.at("paused").get<bool>();
  robot.next_sequence = from.at("next_sequence").get<std::uint32_t>();
  if (from.contains("held_at")) robot.held_at = from.at("held_at").get<std::uint32_t>();
  const json& cells = from.at("cells");
  const json& steps = from.at("steps");
  for (const json& run : from.at("sequences")) {
    const auto first = run.at(0).get<std::uint32_t>();
    const auto count = run.at(1).get<std::uint32_t>();
    // What a run says is not believed before the cells are there.
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::size_t index = robot.visits.size();
      robot.visits.push_back({first + i, cellOf(cells.at(index).get<std::uint32_t>(), width),
                              steps.at(index).get<std::uint32_t>()});
    }
  }
  return robot;
}

/// Bytes that stand as two digits each. @throws InputError where it is no such text.
std::string bytesOf(const std::string& hex) {
  try {
    return boost::algorithm::unhex(hex);
  } catch (const boost::algorithm::hex_decode_error&) {
    throw InputError("its plan is not written in pairs of hexadecimal digits");
  }
}

json toJson(const FleetSnapshot::Part& part) {
  json left_behind = json::array();
  for (const FleetSnapshot::LeftBehind& robot : part.left_behind) {
    json way = json::array();
    for (const PlanePoint& point : robot.way) way.push_back({point.x, point.y});
    left_behind.push_back({{"id", robot.id}, {"way", std::move(way)}, {"removed", robot.removed}});
  }
  json faults = json::array();
  for (const FleetSnapshot::Fault& fault : part.faults) {
    faults.push_back({{"id", fault.id}, {"code", fault.code}, {"message", fault.message}});
  }
  json joined = json::array();
  for (const FleetSnapshot::Joined& robot : part.joined) {
    joined.push_back(
        {{"id", robot.id}, {"place", {robot.place.x, robot.place.y}}, {"waits", robot.waits}});
    if (robot.start) joined.back()["start"] = {robot.start->x, robot.start->y};
  }
  return {{"plan", boost::algorithm::hex(part.plan)},
          {"number", part.number},
          {"elapsed", part.elapsed_sec},
          {"planned", part.planned_sec},
          {"ids", part.ids},
          {"left_behind", std::move(left_behind)},
          {"faults", std::move(faults)},
          {"joined", std::move(joined)}};
}

FleetSnapshot::Part partOf(const json& from) {
  FleetSnapshot::Part part;
  part.plan = bytesOf(from.at("plan").get<std::string>());
  part.number = from.at("number").get<std::uint32_t>();
  part.elapsed_sec = from.at("elapsed").get<double>();
  part.planned_sec = from.at("planned").get<double>();
  part.ids = from.at("ids").get<std::vector<std::string>>();
  for (const json& robot : from.at("left_behind")) {
    FleetSnapshot::LeftBehind left;
    left.id = robot.at("id").get<std::string>();
    left.removed = robot.at("removed").get<bool>();
    for (const json& point : robot.at("way")) {
      left.way.push_back({point.at(0).get<double>(), point.at(1).get<double>()});
    }
    part.left_behind.push_back(std::move(left));
  }
  for (const json& fault : from.at("faults")) {
    part.faults.push_back({fault.at("id").get<std::string>(), fault.at("code").get<std::int32_t>(),
                           fault.at("message").get<std::string>()});
  }
  for (const json& robot : from.at("joined")) {
    const json& place = robot.at("place");
    part.joined.push_back({robot.at("id").get<std::string>(),
                           {place.at(0).get<double>(), place.at(1).get<double>()},
                           robot.at("waits").get<bool>()});
    if (robot.contains("start")) {
      const json& start = robot.at("start");
      part.joined.back().start = {start.at(0).get<double>(), start.at(1).get<double>()};
    }
  }
  return part;
}

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw InputError("the execution file '" + path + "' " + what);
}

/// All but the robots.
json toJson(const FleetSnapshot& snapshot) {
  json blocked = json::array();
  for (const Cell cell : snapshot.blocked) blocked.push_back({cell.x, cell.y});
  json all = {{"format", kFormat},
              {"plan_id", snapshot.plan_id},
              {"size", {snapshot.width, snapshot.height}},
              {"elapsed", snapshot.elapsed_sec},
              {"step", snapshot.step_sec},
              {"release", snapshot.release},
              {"release_ahead", snapshot.release_ahead},
              {"paused", snapshot.all_paused},
              {"cancelled", snapshot.cancelled},
              {"rolling", snapshot.rolling},
              {"blocked", std::move(blocked)}};
  if (snapshot.part) all["part"] = toJson(*snapshot.part);
  return all;
}

std::string textOf(const FleetSnapshot& snapshot) {
  std::string text = toJson(snapshot).dump();
  text.back() = ',';
  std::size_t visits = 0;
  for (const FleetSnapshot::Robot& robot : snapshot.robots) visits += robot.visits.size();
  text.reserve(text.size() + kBytesPerVisit * visits + kBytesPerRobot * snapshot.robots.size());
  text += "\"robots\":[";
  for (const FleetSnapshot::Robot& robot : snapshot.robots) {
    append(text, robot, snapshot.width);
    text += ',';
  }
  if (!snapshot.robots.empty()) text.pop_back();
  text += "]}\n";
  return text;
}

/// JSON has no place for names that are no UTF-8.
std::string textFor(const std::string& path, const FleetSnapshot& snapshot) {
  try {
    return textOf(snapshot);
  } catch (const json::exception& error) {
    fail(path, std::string("cannot be written: ") + error.what());
  }
}

}  // namespace

void writeExecution(const std::string& path, const FleetSnapshot& snapshot) {
  const std::string text = textFor(path, snapshot);
  const std::string fresh = path + ".new";
  {
    std::ofstream file(fresh, std::ios::binary | std::ios::trunc);
    file << text;
    file.flush();
    if (!file) fail(fresh, std::string("cannot be written: ") + std::strerror(errno));
  }
  if (std::rename(fresh.c_str(), path.c_str()) != 0) {
    fail(path, std::string("cannot be replaced: ") + std::strerror(errno));
  }
}

std::optional<FleetSnapshot> readExecution(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file && errno == ENOENT) return std::nullopt;
  if (!file) fail(path, std::string("cannot be opened: ") + std::strerror(errno));
  try {
    const json all = json::parse(file);
    if (all.at("format") != kFormat) fail(path, "has another format than this version reads");
    FleetSnapshot snapshot;
    snapshot.plan_id = all.at("plan_id").get<std::string>();
    snapshot.width = all.at("size").at(0).get<std::uint32_t>();
    snapshot.height = all.at("size").at(1).get<std::uint32_t>();
    snapshot.elapsed_sec = all.at("elapsed").get<double>();
    snapshot.step_sec = all.at("step").get<double>();
    snapshot.release = all.at("release").get<double>();
    snapshot.release_ahead = all.at("release_ahead").get<std::uint32_t>();
    snapshot.all_paused = all.at("paused").get<bool>();
    snapshot.cancelled = all.at("cancelled").get<bool>();
    snapshot.rolling = all.value("rolling", false);
    for (const json& cell : all.at("blocked")) snapshot.blocked.push_back(cellOf(cell));
    for (const json& robot : all.at("robots")) {
      snapshot.robots.push_back(robotOf(robot, snapshot.width));
    }
    if (all.contains("part")) snapshot.part = partOf(all.at("part"));
    return snapshot;
  } catch (const json::exception& error) {
    fail(path, std::string("cannot be read: ") + error.what());
  }
}

void removeExecution(const std::string& path) { std::remove(path.c_str()); }

}  // namespace split_mapf
