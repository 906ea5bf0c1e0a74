#include "targets.h"

#include <cstdint>
#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

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

void readMapBytes(const std::string& bytes) {
  const MemoryFile file(bytes);
  isTaken([&] { readMovingAiMap(file.path()); });
}

void readScenarioBytes(const std::string& bytes) {
  static const std::shared_ptr<const Grid> grid = smallGrid();
  const MemoryFile file(bytes);
  isTaken([&] {
    const Scenario scenario = readMovingAiScenario(file.path(), *grid);
    isTaken([&] { Instance(grid, scenario.starts, scenario.goals); });
  });
}

void readMapServerBytes(const std::string& bytes) {
  const MemoryFile file(bytes);
  isTaken([&] { readMapServerMap(file.path()); });
}

/// A picture as a map names it, so that the map itself is always right.
void readPictureBytes(const std::string& bytes) {
  const MemoryFile picture(bytes);
  const MemoryFile file("image: " + picture.path() +
                        "\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
                        "occupied_thresh: 0.65\nfree_thresh: 0.196\nmode: scale\n");
  isTaken([&] { readMapServerMap(file.path()); });
}

void readPlanBytes(const std::string& bytes) {
  static const std::shared_ptr<const Grid> grid = smallGrid();
  static const Instance instance(grid, {{0, 0}, {7, 7}}, {{7, 0}, {0, 7}});
  const MemoryFile file(bytes);
  isTaken([&] { validate(instance, readPlanJson(file.path())); });
  isTaken([&] { readPlanLayout(file.path(), *grid); });
  isTaken([&] { readDiscPlanJson(file.path()); });
}

void readPoseBytes(const std::string& bytes) {
  const MemoryFile file(bytes);
  isTaken([&] { readPoseScenario(file.path()); });
}

void readTaskBytes(const std::string& bytes) {
  static const std::shared_ptr<const Grid> grid = smallGrid();
  const MemoryFile file(bytes);
  isTaken([&] { readGoalLists(file.path(), *grid); });
  isTaken([&] { readLeagueAgents(file.path(), *grid); });
  isTaken([&] { readLeagueTasks(file.path(), *grid); });
}

/// The first line is a specification, each further one an option NAME=VALUE.
void readSplitBytes(const std::string& bytes) {
  std::map<std::string, std::string> options;
  std::size_t begin = bytes.find('\n');
  isTaken([&] { parseSplitSpec(bytes.substr(0, begin)); });
  while (begin != std::string::npos) {
    const std::size_t end = bytes.find('\n', ++begin);
    const std::string line = bytes.substr(begin, end - begin);
    const std::size_t equals = line.find('=');
    if (equals != std::string::npos) options[line.substr(0, equals)] = line.substr(equals + 1);
    begin = end;
  }
  for (const Objective objective : {Objective::kMakespan, Objective::kSumOfCosts}) {
    isTaken([&] { readSplitOptions(options, objective); });
  }
}

/// What is taken must come out as it went in.
void readProblemBytes(const std::string& bytes) {
  isTaken([&] {
    const Problem problem = problemFromBytes(bytes);
    const std::string again = toBytes(problem);
    if (toBytes(problemFromBytes(again)) != again) {
      throw std::logic_error("a problem changes when it is written and read");
    }
  });
}

void readRobotBytes(const std::string& bytes) {
  isTaken([&] { parseVda5050State(bytes); });
  isTaken([&] { parseVda5050Connection(bytes); });
}

}  // namespace

const std::map<std::string, Target>& targets() {
  static const std::map<std::string, Target> all = {
      {"map", readMapBytes},           {"map_server", readMapServerBytes},
      {"picture", readPictureBytes},   {"plan", readPlanBytes},
      {"poses", readPoseBytes},        {"problem", readProblemBytes},
      {"scenario", readScenarioBytes}, {"split", readSplitBytes},
      {"tasks", readTaskBytes},        {"vda5050", readRobotBytes},
  };
  return all;
}

}  // namespace split_mapf::fuzz
