#include "pipeline/goal_source.h"

#include <algorithm>
#include <string>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kNoPart = 0xffffffffU;

/// The connected parts of a graph; fills the part of each vertex.
std::vector<std::vector<Vertex>> partsOf(const Graph& graph, std::vector<std::uint32_t>& part) {
  std::vector<std::vector<Vertex>> parts;
  part.assign(graph.size(), kNoPart);
  for (Vertex first = 0; first < graph.size(); ++first) {
    if (part[first] != kNoPart) continue;
    const auto number = static_cast<std::uint32_t>(parts.size());
    std::vector<Vertex> vertices = {first};
    part[first] = number;
    for (std::size_t head = 0; head < vertices.size(); ++head) {
      for (const Vertex u : graph.neighbours(vertices[head])) {
        if (part[u] != kNoPart) continue;
        part[u] = number;
        vertices.push_back(u);
      }
    }
    std::sort(vertices.begin(), vertices.end());
    parts.push_back(std::move(vertices));
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
  if (random_) parts_ = partsOf(grid.graph(), part_);
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
  std::vector<std::vector<Vertex>> parts = partsOf(grid.graph(), part);
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
