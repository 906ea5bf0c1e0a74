#include "pipeline/goal_source.h"

#include <algorithm>
#include <string>
#include <unordered_map>

#include "split_mapf/core/error.h"
#include "split_mapf/core/grid_parts.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

/// The connected parts of a grid, each in order; fills the part of each vertex.
std::vector<std::vector<Vertex>> partsOf(const Grid& grid, std::vector<std::uint32_t>& part) {
  const GridParts connected(grid);
  std::vector<std::vector<Vertex>> parts;
  std::unordered_map<std::uint32_t, std::uint32_t> numbers;
  part.resize(grid.size());
  for (Vertex v = 0; v < part.size(); ++v) {
    const auto next = static_cast<std::uint32_t>(parts.size());
    const auto [number, is_new] = numbers.emplace(connected.partOf(v), next);
    if (is_new) parts.emplace_back();
    part[v] = number->second;
    parts[part[v]].push_back(v);
  }
  return parts;
}

}  // namespace

GoalSource::GoalSource(const Grid& grid, const RollTask& task, std::uint64_t seed)
    : goals_(task.goals),
      given_(task.starts.size(), 0),
      random_(task.random),
      engine_(seed),
      last_(task.starts) {
  if (!random_ && goals_.size() != task.starts.size()) {
    throw InputError("there are goals of " + counted(goals_.size(), "robot") + " and starts of " +
                     std::to_string(task.starts.size()));
  }
  for (const Vertex start : task.starts) {
    if (start >= grid.size()) {
      throw InputError("a start is vertex " + std::to_string(start) + "; the map has " +
                       std::to_string(grid.size()));
    }
  }
  if (random_) parts_ = partsOf(grid, part_);
}

Vertex GoalSource::next(std::uint32_t robot) {
  if (!random_) {
    if (given_[robot] == goals_[robot].size()) return kNoVertex;
    return goals_[robot][given_[robot]++];
  }
  const std::vector<Vertex>& part = parts_[part_[last_[robot]]];
  if (part.size() < 2) return kNoVertex;
  Vertex goal = last_[robot];
  while (goal == last_[robot]) goal = part[drawBelow(engine_, part.size())];
  last_[robot] = goal;
  return goal;
}

std::vector<Vertex> drawStarts(const Grid& grid, std::uint32_t robots, std::uint64_t seed) {
  std::vector<std::uint32_t> part;
  std::vector<std::vector<Vertex>> parts = partsOf(grid, part);
  std::vector<Vertex> largest;
  for (std::vector<Vertex>& vertices : parts) {
    if (vertices.size() > largest.size()) largest.swap(vertices);
  }
  if (robots > largest.size()) {
    throw InputError(counted(robots, "robot") +
                     " were asked for; the largest connected part of the " + "map has " +
                     counted(largest.size(), "cell"));
  }
  RandomEngine engine(seed ^ 0x9e3779b97f4a7c15U);
  shuffle(largest, engine);
  largest.resize(robots);
  return largest;
}

}  // namespace split_mapf
