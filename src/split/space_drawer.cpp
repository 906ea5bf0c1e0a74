#include "split/space_drawer.h"

#include <algorithm>

namespace split_mapf {
namespace {

// So many draws before a region is merged.
constexpr std::uint32_t kMostDraws = 3;

}  // namespace

std::uint32_t closestNeighbour(const Graph& graph, const Ownership& ownership,
                               std::uint32_t region) {
  std::map<std::uint32_t, std::uint32_t> edges;
  for (Vertex v = 0; v < graph.size(); ++v) {
    if (ownership[v] != region) continue;
    for (const Vertex u : graph.neighbours(v)) {
      if (ownership[u] != region) ++edges[ownership[u]];
    }
  }
  std::uint32_t closest = kNoRegion;
  std::uint32_t most = 0;
  for (const auto& [neighbour, count] : edges) {
    if (count > most) {
      most = count;
      closest = neighbour;
    }
  }
  return closest;
}

SpaceSplit::Drawer::Drawer(const Instance& instance, const SpaceSplitOptions& options,
                           Partition partition)
    : instance_(instance),
      options_(options),
      partition_(std::move(partition)),
      states_(instance, partition_, options),
      grids_(instance.sharedGrid()) {}

const SolvabilityChecker& SpaceSplit::Drawer::checkerOf(std::uint32_t number,
                                                        const RegionGrid& grid,
                                                        std::uint32_t region) {
  const auto key = std::make_pair(number, region);
  const auto known = checkers_.find(key);
  if (known != checkers_.end()) return known->second;
  return checkers_.emplace(key, SolvabilityChecker(grid.grid->graph())).first->second;
}

bool SpaceSplit::Drawer::reachable(const RegionQuestion& question, std::uint32_t number,
                                   const std::vector<Vertex>& to, const Deadline& deadline) {
  if (!options_.check) return true;
  const RegionGrid& grid = grids_.of(number, *question.ownership, question.region);
  std::vector<Vertex> starts;
  std::vector<Vertex> goals;
  for (std::size_t i = 0; i < to.size(); ++i) {
    starts.push_back(grid.localOf((*question.from)[question.robots[i]]));
    goals.push_back(grid.localOf(to[i]));
  }
  return checkerOf(number, grid, question.region).check(starts, goals, deadline).answer !=
         Solvability::kUnsolvable;
}

std::vector<Vertex> SpaceSplit::Drawer::draw(RegionQuestion question, std::uint32_t number,
                                             const Deadline& deadline) {
  for (std::uint32_t attempt = 0; attempt < kMostDraws && !deadline.expired(); ++attempt) {
    std::vector<Vertex> to = states_.choose(question, deadline);
    if (!to.empty() && reachable(question, number, to, deadline)) return to;
    ++question.attempt;
  }
  return {};
}

RegionQuestion SpaceSplit::Drawer::questionFor(const std::vector<Vertex>& from,
                                               std::uint32_t phase) const {
  RegionQuestion question;
  question.turn = phase % 2;
  question.from = &from;
  std::uint32_t left = 0;
  std::uint32_t phases = 1;
  for (std::uint32_t robot = 0; robot < instance_.robots(); ++robot) {
    left = std::max(left, instance_.distances(robot)(from[robot]));
    const std::uint32_t needed = states_.phasesNeeded(robot, from[robot], question.turn);
    if (needed < RegionGraph::kFar) phases = std::max(phases, needed);
  }
  question.phases_left = phases;
  // The paper's estimate of the number of phases; a robot that needs more has little to do there.
  const std::uint32_t usual = options_.rows + options_.columns - 1;
  const std::uint32_t shares = std::min(phases, usual > phase ? usual - phase : 1);
  question.share.piece = options_.phase_steps > 0 ? std::min(options_.phase_steps, left)
                                                  : (left + shares - 1) / shares;
  question.share.rest = left - question.share.piece;
  return question;
}

}  // namespace split_mapf
