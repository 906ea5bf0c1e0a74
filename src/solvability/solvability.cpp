#include "split_mapf/solvability/solvability.h"

#include <stdexcept>
#include <string>

#include "solvability/bridge_structure.h"
#include "solvability/part_check.h"
#include "split_mapf/core/grid_parts.h"
#include "split_mapf/core/way_band.h"
#include "split_mapf/core/wording.h"

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

/// @param part_of  of a vertex @param size_of  of a part, in vertices
template <typename PartOf, typename SizeOf>
std::optional<SolvabilityVerdict> findCutOff(const PartOf& part_of, const SizeOf& size_of,
                                             const std::vector<Vertex>& starts,
                                             const std::vector<Vertex>& goals) {
  SolvabilityVerdict verdict;
  for (std::uint32_t robot = 0; robot < starts.size(); ++robot) {
    if (part_of(starts[robot]) == part_of(goals[robot])) continue;
    verdict.robots.push_back(robot);
    verdict.vertices.push_back(starts[robot]);
    verdict.vertices.push_back(goals[robot]);
  }
  if (verdict.robots.empty()) return std::nullopt;
  verdict.answer = Solvability::kUnsolvable;
  verdict.refusal = RefusalKind::kDifferentComponents;
  const std::uint32_t part = part_of(verdict.vertices[0]);
  verdict.cells = size_of(part);
  verdict.blanks = verdict.cells;
  for (const Vertex v : starts) verdict.blanks -= part_of(v) == part ? 1 : 0;
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

/// Whether a plan exists on the cells around the robots' shortest ways.
bool isSolvableNearWays(const Instance& instance, const Deadline& deadline) {
  const std::vector<Path> ways = findShortestWays(instance, deadline);
  if (ways.empty()) return false;
  for (const std::uint32_t margin : WayBand::kMargins) {
    const WayBand band(instance, ways, margin, deadline);
    if (band.isNearlyAll()) return false;
    const Instance& near = band.instance();
    const SolvabilityVerdict verdict =
        checkSolvable(near.grid().graph(deadline), near.starts(), near.goals(), deadline);
    if (verdict.answer != Solvability::kUnsolvable) return verdict.answer == Solvability::kSolvable;
  }
  return false;
}

SolvabilityVerdict undecided() {
  SolvabilityVerdict verdict;
  verdict.answer = Solvability::kUndecided;
  return verdict;
}

}  // namespace

SolvabilityChecker::SolvabilityChecker(const Graph& graph, const Deadline& deadline)
    : graph_(&graph), structure_(std::make_shared<const BridgeStructure>(graph, deadline)) {}

SolvabilityVerdict SolvabilityChecker::check(const std::vector<Vertex>& starts,
                                             const std::vector<Vertex>& goals,
                                             const Deadline& deadline) const {
  if (starts.size() != goals.size()) {
    throw std::invalid_argument(counted(starts.size(), "start") + " but " +
                                counted(goals.size(), "goal"));
  }
  requireDistinct(*graph_, starts, "start");
  requireDistinct(*graph_, goals, "goal");
  if (deadline.expired()) return undecided();
  const auto part_of = [this](Vertex v) { return structure_->partOf(v); };
  const auto size_of = [this](std::uint32_t part) { return structure_->parts()[part].size; };
  if (auto refusal = findCutOff(part_of, size_of, starts, goals)) return *refusal;
  try {
    return checkParts(starts, goals, deadline);
  } catch (const Interrupted&) {
    return undecided();
  }
}

SolvabilityVerdict SolvabilityChecker::checkParts(const std::vector<Vertex>& starts,
                                                  const std::vector<Vertex>& goals,
                                                  const Deadline& deadline) const {
  const auto doubtful = robotsOfDoubtfulParts(*structure_, starts);
  if (doubtful.empty()) return {};
  CheckTables tables = {*graph_,
                        *structure_,
                        starts,
                        goals,
                        deadline,
                        std::vector<std::uint32_t>(graph_->size(), kNoVertex),
                        std::vector<std::uint32_t>(starts.size())};
  for (const std::vector<std::uint32_t>& robots : doubtful) {
    deadline.require();
    const std::uint32_t part = structure_->partOf(starts[robots.front()]);
    if (auto refusal = PartCheck(part, robots, tables).findRefusal()) return *refusal;
  }
  return {};
}

SolvabilityVerdict checkSolvable(const Graph& graph, const std::vector<Vertex>& starts,
                                 const std::vector<Vertex>& goals, const Deadline& deadline) {
  try {
    return SolvabilityChecker(graph, deadline).check(starts, goals, deadline);
  } catch (const Interrupted&) {
    return undecided();
  }
}

SolvabilityVerdict checkReachable(const Instance& instance, const Deadline& deadline) {
  const GridParts parts(instance.grid(), deadline);
  return findCutOff([&](Vertex v) { return parts.partOf(v); },
                    [&](std::uint32_t part) { return parts.sizeOf(part); }, instance.starts(),
                    instance.goals())
      .value_or(SolvabilityVerdict());
}

SolvabilityVerdict checkSolvable(const Instance& instance, const Deadline& deadline) {
  try {
    if (instance.grid().isHuge()) {
      SolvabilityVerdict verdict = checkReachable(instance, deadline);
      if (verdict.answer == Solvability::kUnsolvable) return verdict;
      if (isSolvableNearWays(instance, deadline)) return {};
    }
    const Graph& graph = instance.grid().graph(deadline);
    return checkSolvable(graph, instance.starts(), instance.goals(), deadline);
  } catch (const Interrupted&) {
    return undecided();
  }
}

}  // namespace split_mapf
