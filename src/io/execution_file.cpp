#include "split_mapf/io/execution_file.h"

#include <cerrno>
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

constexpr const char* kFormat = "split_mapf execution 3";

json toJson(const FleetSnapshot::Robot& robot) {
  json sequences = json::array();
  json cells = json::array();
  json steps = json::array();
  for (const FleetSnapshot::Visit& visit : robot.visits) {
    sequences.push_back(visit.sequence);
    cells.push_back({visit.cell.x, visit.cell.y});
    steps.push_back(visit.step);
  }
  json all = {{"id", robot.id},
              {"goal", {robot.goal.x, robot.goal.y}},
              {"planned", robot.planned_sec},
              {"paused", robot.paused},
              {"next_sequence", robot.next_sequence},
              {"sequences", std::move(sequences)},
              {"cells", std::move(cells)},
              {"steps", std::move(steps)}};
  if (robot.held_at) all["held_at"] = *robot.held_at;
  return all;
}

Cell cellOf(const json& pair) { return {pair.at(0).get<int>(), pair.at(1).get<int>()}; }

FleetSnapshot::Robot robotOf(const json& from) {
  FleetSnapshot::Robot robot;
  robot.id = from.at("id").get<std::string>();
  robot.goal = cellOf(from.at("goal"));
  robot.planned_sec = from.at("planned").get<double>();
  robot.paused = from.at("paused").get<bool>();
  robot.next_sequence = from.at("next_sequence").get<std::uint32_t>();
  if (from.contains("held_at")) robot.held_at = from.at("held_at").get<std::uint32_t>();
  const json& cells = from.at("cells");
  for (std::size_t i = 0; i < cells.size(); ++i) {
    robot.visits.push_back({from.at("sequences").at(i).get<std::uint32_t>(), cellOf(cells[i]),
                            from.at("steps").at(i).get<std::uint32_t>()});
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
  return {{"plan", boost::algorithm::hex(part.plan)},
          {"number", part.number},
          {"elapsed", part.elapsed_sec},
          {"planned", part.planned_sec},
          {"ids", part.ids},
          {"left_behind", std::move(left_behind)},
          {"faults", std::move(faults)}};
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
  return part;
}

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw InputError("the execution file '" + path + "' " + what);
}

/// JSON has no place for names that are no UTF-8.
std::string textOf(const std::string& path, const json& all) {
  try {
    return all.dump();
  } catch (const json::exception& error) {
    fail(path, std::string("cannot be written: ") + error.what());
  }
}

}  // namespace

void writeExecution(const std::string& path, const FleetSnapshot& snapshot) {
  json robots = json::array();
  for (const FleetSnapshot::Robot& robot : snapshot.robots) robots.push_back(toJson(robot));
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
              {"blocked", std::move(blocked)},
              {"robots", std::move(robots)}};
  if (snapshot.part) all["part"] = toJson(*snapshot.part);
  const std::string text = textOf(path, all);
  const std::string fresh = path + ".new";
  {
    std::ofstream file(fresh, std::ios::binary | std::ios::trunc);
    file << text << '\n';
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
    for (const json& robot : all.at("robots")) snapshot.robots.push_back(robotOf(robot));
    if (all.contains("part")) snapshot.part = partOf(all.at("part"));
    return snapshot;
  } catch (const json::exception& error) {
    fail(path, std::string("cannot be read: ") + error.what());
  }
}

void removeExecution(const std::string& path) { std::remove(path.c_str()); }

}  // namespace split_mapf
