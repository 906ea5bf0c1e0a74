#include "split_mapf/core/solvability.h"

#include <stdexcept>
#include <string>

#include "core/bridge_structure.h"
#include "core/part_check.h"

namespace split_mapf {
namespace {

void requireDistinct(const Graph& graph, const std::vector<Vertex>& vertices, const char* role) {
  std::vector<bool> taken(graph.size(), false);
  for (std::size_t robot = 0; robot < vertices.size(); ++robot) {
    const Vertex v = vertices[robot];
    if (v < graph.size() && !taken[v]) {
      taken[v] = true;
      continue;
    }
    throw std::invalid_argument(
        "robot " + std::to_string(robot) + ": its " + role + ", vertex " + std::to_string(v) +
        (v < graph.size() ? ", is also another robot's"
                          : ", is not one of the graph's " + std::to_string(graph.size())));
  }
}

std::optional<SolvabilityVerdict> findCutOff(const BridgeStructure& structure,
                                             const std::vector<Vertex>& starts,
                                             const std::vector<Vertex>& goals) {
  SolvabilityVerdict verdict;
  for (std::uint32_t robot = 0; robot < starts.size(); ++robot) {
    if (structure.partOf(starts[robot]) == structure.partOf(goals[robot])) continue;
    verdict.robots.push_back(robot);
    verdict.vertices.push_back(starts[robot]);
    verdict.vertices.push_back(goals[robot]);
  }
  if (verdict.robots.empty()) return std::nullopt;
  verdict.answer = Solvability::kUnsolvable;
  verdict.refusal = RefusalKind::kDifferentComponents;
  const std::uint32_t part = structure.partOf(verdict.vertices[0]);
  verdict.cells = structure.parts()[part].size;
  verdict.blanks = verdict.cells;
  for (const Vertex v : starts) verdict.blanks -= structure.partOf(v) == part ? 1 : 0;
  return verdict;
}

/// The robots of each part that has too few empty vertices to be solvable whatever is asked.
std::vector<std::vector<std::uint32_t>> robotsOfDoubtfulParts(const BridgeStructure& structure,
                                                              const std::vector<Vertex>& starts) {
  std::vector<std::uint32_t> robots(structure.parts().size(), 0);
  for (const Vertex v : starts) ++robots[structure.partOf(v)];
  std::vector<std::vector<std::uint32_t>> doubtful;
  constexpr std::uint32_t kNotListed = 0xffffffffU;
  std::vector<std::uint32_t> index(robots.size(), kNotListed);
  for (std::uint32_t robot = 0; robot < starts.size(); ++robot) {
    const std::uint32_t part = structure.partOf(starts[robot]);
    const GraphPart& shape = structure.parts()[part];
    if (shape.size - robots[part] >= shape.enough_blanks) continue;
    if (index[part] == kNotListed) {
      index[part] = static_cast<std::uint32_t>(doubtful.size());
      doubtful.emplace_back();
    }
    doubtful[index[part]].push_back(robot);
  }
  return doubtful;
}

SolvabilityVerdict undecided() {
  SolvabilityVerdict verdict;
  verdict.answer = Solvability::kUndecided;
  return verdict;
}

}  // namespace

SolvabilityChecker::SolvabilityChecker(const Graph& graph)
    : graph_(&graph), structure_(std::make_shared<const BridgeStructure>(graph)) {}

SolvabilityVerdict SolvabilityChecker::check(const std::vector<Vertex>& starts,
                                             const std::vector<Vertex>& goals,
                                             const Deadline& deadline) const {
  if (starts.size() != goals.size()) {
    throw std::invalid_argument(std::to_string(starts.size()) + " starts but " +
                                std::to_string(goals.size()) + " goals");
  }
  requireDistinct(*graph_, starts, "start");
  requireDistinct(*graph_, goals, "goal");
  if (deadline.expired()) return undecided();
  if (auto refusal = findCutOff(*structure_, starts, goals)) return *refusal;
  const auto doubtful = robotsOfDoubtfulParts(*structure_, starts);
  if (doubtful.empty()) return {};
  CheckTables tables = {*graph_,
                        *structure_,
                        starts,
                        goals,
                        std::vector<std::uint32_t>(graph_->size(), kNoVertex),
                        std::vector<std::uint32_t>(starts.size())};
  for (const std::vector<std::uint32_t>& robots : doubtful) {
    if (deadline.expired()) return undecided();
    const std::uint32_t part = structure_->partOf(starts[robots.front()]);
    if (auto refusal = PartCheck(part, robots, tables).findRefusal()) return *refusal;
  }
  return {};
}

SolvabilityVerdict checkSolvable(const Graph& graph, const std::vector<Vertex>& starts,
                                 const std::vector<Vertex>& goals, const Deadline& deadline) {
  return SolvabilityChecker(graph).check(starts, goals, deadline);
}

SolvabilityVerdict checkSolvable(const Instance& instance, const Deadline& deadline) {
  return checkSolvable(instance.graph(), instance.starts(), instance.goals(), deadline);
}

}  // namespace split_mapf
