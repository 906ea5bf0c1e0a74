#include "targets.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "goal_target.h"
#include "memory_file.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/io/map_server.h"
#include "split_mapf/io/movingai.h"
#include "split_mapf/io/plan_json.h"
#include "split_mapf/io/pose_scenario.h"
#include "split_mapf/io/problem_bytes.h"
#include "split_mapf/io/task_file.h"
#include "split_mapf/io/vda5050.h"
#include "split_mapf/pipeline/piece_messages.h"
#include "split_mapf/roadmap/obstacle_raster.h"
#include "split_mapf/roadmap/roadmap.h"
#include "split_mapf/solver/registry.h"
#include "split_mapf/split/split_options.h"
#include "split_mapf/split/split_spec.h"

namespace split_mapf::fuzz {
namespace {

/// Whether the call takes what it got.
template <class Call>
bool isTaken(Call call) {
  try {
    call();
    return true;
  } catch (const InputError& error) {
    if (*error.what() == '\0') throw std::logic_error("refused without a word");
    return false;
  }
}

/// 8 x 8 cells, the two in the middle of the second row blocked.
std::shared_ptr<const Grid> smallGrid() {
  std::vector<bool> free(64, true);
  free[11] = free[12] = false;
  return std::make_shared<const Grid>(8, 8, free);
}

bool readMapBytes(const std::string& bytes) {
  const MemoryFile file(bytes);
  return isTaken([&] { readMovingAiMap(file.path()); });
}

bool readScenarioBytes(const std::string& bytes) {
  static const std::shared_ptr<const Grid> grid = smallGrid();
  const MemoryFile file(bytes);
  return isTaken([&] {
    const Scenario scenario = readMovingAiScenario(file.path(), *grid);
    Instance(grid, scenario.starts, scenario.goals);
  });
}

/// The map with the path of a picture in place of the plain name after its first `image: `: a map
/// in memory stands in no folder of pictures, and what comes behind the name would never be tried.
std::string withPicture(std::string bytes, const std::string& picture) {
  const std::string key = "image: ";
  const std::size_t at = bytes.find(key);
  if (at == std::string::npos) return bytes;
  const std::size_t begin = at + key.size();
  std::size_t end = begin;
  while (end < bytes.size() && (std::isalnum(static_cast<unsigned char>(bytes[end])) != 0 ||
                                bytes[end] == '.' || bytes[end] == '_')) {
    ++end;
  }
  if (end > begin) bytes.replace(begin, end - begin, picture);
  return bytes;
}

bool readMapServerBytes(const std::string& bytes) {
  static const MemoryFile picture("P2 2 2 255\n0 255 255 254\n");
  const MemoryFile file(withPicture(bytes, picture.path()));
  return isTaken([&] { readMapServerMap(file.path()); });
}

/// A picture as a map names it, so that the map itself is always right.
bool readPictureBytes(const std::string& bytes) {
  const MemoryFile picture(bytes);
  const MemoryFile file("image: " + picture.path() +
                        "\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
                        "occupied_thresh: 0.65\nfree_thresh: 0.196\nmode: scale\n");
  return isTaken([&] { readMapServerMap(file.path()); });
}

bool readPlanBytes(const std::string& bytes) {
  static const std::shared_ptr<const Grid> grid = smallGrid();
  static const Instance instance(grid, {{0, 0}, {7, 7}}, {{7, 0}, {0, 7}});
  const MemoryFile file(bytes);
  const bool is_plan = isTaken([&] { validate(instance, readPlanJson(file.path())); });
  const bool has_layout = isTaken([&] { readPlanLayout(file.path(), *grid); });
  const bool is_of_discs = isTaken([&] { readDiscPlanJson(file.path()); });
  return (is_plan && has_layout) || is_of_discs;
}

bool readPoseBytes(const std::string& bytes) {
  const MemoryFile file(bytes);
  return isTaken([&] { readPoseScenario(file.path()); });
}

bool readTaskBytes(const std::string& bytes) {
  static const std::shared_ptr<const Grid> grid = smallGrid();
  const MemoryFile file(bytes);
  const bool is_lists = isTaken([&] { readGoalLists(file.path(), *grid); });
  const bool is_agents = isTaken([&] { readLeagueAgents(file.path(), *grid); });
  const bool is_tasks = isTaken([&] { readLeagueTasks(file.path(), *grid); });
  return is_lists || is_agents || is_tasks;
}

/// The first line is a specification, each further one an option NAME=VALUE.
bool readSplitBytes(const std::string& bytes) {
  std::map<std::string, std::string> options;
  std::size_t begin = bytes.find('\n');
  bool are_all_taken = isTaken([&] { parseSplitSpec(bytes.substr(0, begin)); });
  while (begin != std::string::npos) {
    const std::size_t end = bytes.find('\n', ++begin);
    const std::string line = bytes.substr(begin, end - begin);
    const std::size_t equals = line.find('=');
    if (equals != std::string::npos) options[line.substr(0, equals)] = line.substr(equals + 1);
    begin = end;
  }
  for (const Objective objective : {Objective::kMakespan, Objective::kSumOfCosts}) {
    if (!isTaken([&] { readSplitOptions(options, objective); })) are_all_taken = false;
  }
  return are_all_taken;
}

/// What is taken must come out as it went in.
template <class Value>
void requireSameAgain(const Value& value, Value (*read)(const std::string&)) {
  const std::string bytes = toBytes(value);
  if (toBytes(read(bytes)) != bytes) {
    throw std::logic_error("what was read changes when it is written and read");
  }
}

bool readProblemBytes(const std::string& bytes) {
  return isTaken([&] { requireSameAgain(problemFromBytes(bytes), problemFromBytes); });
}

/// What a worker is asked, as far as its solver is made; what a client is answered, as far as the
/// plan is validated.
bool readPieceMessageBytes(const std::string& bytes) {
  static const Instance instance(smallGrid(), {{0, 0}, {7, 7}}, {{7, 0}, {0, 7}});
  const bool is_question = isTaken([&] {
    const PieceQuestion question = questionFromBytes(bytes);
    requireSameAgain(question, questionFromBytes);
    builtinSolvers().create(question.solver, question.options);
  });
  const bool is_answer = isTaken([&] {
    const PieceAnswer answer = answerFromBytes(bytes);
    requireSameAgain(answer, answerFromBytes);
    if (answer.result.plan) validate(instance, *answer.result.plan);
  });
  return is_question || is_answer;
}

/// The first line has radius, clearance, cell size and resolution [m], and whether passages are
/// laid; the others are rows of a map, '#' being blocked. A graph that is built has been proved.
bool buildRoadmapOfBytes(const std::string& bytes) {
  constexpr std::uint32_t kMostSide = 64;
  std::istringstream in(bytes);
  RoadmapOptions options;
  ObstacleRaster raster;
  in >> options.robot_radius_m >> options.clearance_m >> options.cell_size_m >>
      raster.resolution_m >> options.passages;
  if (!in || !(raster.resolution_m > 0) || !std::isfinite(raster.resolution_m)) return false;
  for (std::string row; in >> row && raster.height < kMostSide; ++raster.height) {
    if (raster.width == 0) {
      raster.width = static_cast<std::uint32_t>(std::min<std::size_t>(row.size(), kMostSide));
    }
    row.resize(raster.width, '.');
    for (const char c : row) raster.blocked.push_back(c == '#' ? 1 : 0);
  }
  if (raster.height == 0) return false;
  return isTaken([&] { buildRoadmap(raster, options); });
}

bool readRobotBytes(const std::string& bytes) {
  const bool is_state = isTaken([&] { parseVda5050State(bytes); });
  const bool is_connection = isTaken([&] { parseVda5050Connection(bytes); });
  return is_state || is_connection;
}

}  // namespace

const std::map<std::string, Target>& targets() {
  static const std::map<std::string, Target> all = {
#ifdef SPLIT_MAPF_FUZZ_GOAL
      {"goal", placeGoalOfBytes},
#endif
      {"map", readMapBytes},           {"map_server", readMapServerBytes},
      {"picture", readPictureBytes},   {"piece_messages", readPieceMessageBytes},
      {"plan", readPlanBytes},         {"poses", readPoseBytes},
      {"problem", readProblemBytes},   {"roadmap", buildRoadmapOfBytes},
      {"scenario", readScenarioBytes}, {"split", readSplitBytes},
      {"tasks", readTaskBytes},        {"vda5050", readRobotBytes},
  };
  return all;
}

}  // namespace split_mapf::fuzz
