#include "solvability/part_check.h"

#include <algorithm>
#include <map>

#include "core/loop_order.h"
#include "solvability/blank_normalisation.h"
#include "solvability/exchange_classes.h"

namespace split_mapf {

PartCheck::PartCheck(std::uint32_t part, const std::vector<std::uint32_t>& robots,
                     CheckTables& tables)
    : part_(tables.structure.parts()[part]),
      robots_(robots),
      tables_(tables),
      blanks_(part_.size - static_cast<std::uint32_t>(robots.size())),
      tree_(growPartTree(tables.graph, part_.root, tables.rank_of, tables.deadline)),
      at_start_(robotsByRank(tables.starts)),
      at_goal_(robotsByRank(tables.goals)) {}

std::optional<SolvabilityVerdict> PartCheck::findRefusal() {
  if (part_.is_ring) {
    std::vector<std::uint32_t> ranks(tree_.size());
    for (std::uint32_t rank = 0; rank < tree_.size(); ++rank) ranks[rank] = rank;
    return compareRing(ranks);
  }
  at_start_ = gatherBlanks(tree_, at_start_, tables_.deadline);
  at_goal_ = gatherBlanks(tree_, at_goal_, tables_.deadline);
  std::optional<SolvabilityVerdict> refusal = compareClasses();
  if (!refusal && blanks_ == 0) refusal = compareFullLoops();
  return refusal;
}

SolvabilityVerdict PartCheck::refuse(RefusalKind kind,
                                     std::optional<std::uint32_t> blanks_needed) const {
  SolvabilityVerdict verdict;
  verdict.answer = Solvability::kUnsolvable;
  verdict.refusal = kind;
  verdict.cells = part_.size;
  verdict.blanks = blanks_;
  verdict.blanks_needed = blanks_needed;
  return verdict;
}

std::vector<std::uint32_t> PartCheck::robotsByRank(const std::vector<Vertex>& places) const {
  std::vector<std::uint32_t> robots(tree_.size(), kNoRobot);
  for (const std::uint32_t robot : robots_) robots[tables_.rank_of[places[robot]]] = robot;
  return robots;
}

std::optional<SolvabilityVerdict> PartCheck::compareClasses() {
  const ExchangeClasses classes(tree_, tables_.structure, blanks_, tables_.deadline);
  for (std::uint32_t rank = blanks_; rank < tree_.size(); ++rank) {
    tables_.goal_rank[at_goal_[rank]] = rank;
  }
  for (std::uint32_t rank = blanks_; rank < tree_.size(); ++rank) {
    const std::uint32_t robot = at_start_[rank];
    const std::uint32_t goal = tables_.goal_rank[robot];
    if (classes.classOf(rank) == classes.classOf(goal)) continue;
    if (part_.root_kind == PlaceKind::kCorridor) return refusePath(rank);
    const ExchangeClasses::Barrier& barrier = classes.hardestBetween(rank, goal);
    if (blanks_ == 0) return refuseBridge(rank, goal, *barrier.blanks_needed);
    SolvabilityVerdict verdict = refuse(RefusalKind::kClassMismatch, barrier.blanks_needed);
    addOpposite(
        rank, goal, [&](std::uint32_t r) { return barrier.isBeyond(r); }, verdict);
    std::uint32_t r = barrier.corridor_end;
    for (std::uint32_t i = 0; i <= barrier.corridor_length; ++i, r = tree_.parent[r]) {
      verdict.vertices.push_back(tree_.vertices[r]);
    }
    std::reverse(verdict.vertices.begin(), verdict.vertices.end());
    return verdict;
  }
  return std::nullopt;
}

/// At the first difference the robot that starts there and the one that ends there stand in one
/// order before and in the other after.
SolvabilityVerdict PartCheck::refusePath(std::uint32_t rank) const {
  SolvabilityVerdict verdict = refuse(RefusalKind::kPathOrder, std::nullopt);
  verdict.robots = {at_start_[rank], at_goal_[rank]};
  verdict.vertices = tree_.vertices;
  return verdict;
}

/// Names the first bridge on the way from one rank to the other.
SolvabilityVerdict PartCheck::refuseBridge(std::uint32_t from, std::uint32_t to,
                                           std::uint32_t blanks_needed) const {
  std::vector<std::uint32_t> forth = {from};
  std::vector<std::uint32_t> back = {to};
  while (forth.back() != back.back()) {
    std::vector<std::uint32_t>& deeper = forth.back() > back.back() ? forth : back;
    deeper.push_back(tree_.parent[deeper.back()]);
  }
  forth.insert(forth.end(), back.rbegin() + 1, back.rend());
  std::size_t i = 0;
  while (shareLoop(forth[i], forth[i + 1])) ++i;
  const std::uint32_t beyond = std::max(forth[i], forth[i + 1]);
  SolvabilityVerdict verdict = refuse(RefusalKind::kNoBlankBridge, blanks_needed);
  const auto is_beyond = [&](std::uint32_t r) {
    return beyond <= r && r < tree_.subtree_end[beyond];
  };
  addOpposite(from, to, is_beyond, verdict);
  verdict.vertices = {tree_.vertices[forth[i]], tree_.vertices[forth[i + 1]]};
  return verdict;
}

bool PartCheck::shareLoop(std::uint32_t rank, std::uint32_t other) const {
  const std::uint32_t loop = tables_.structure.loopOf(tree_.vertices[rank]);
  return loop != BridgeStructure::kNoLoop &&
         loop == tables_.structure.loopOf(tree_.vertices[other]);
}

/// Names the robot that goes from one rank to the other, and one that must cross the barrier in the
/// opposite direction. There is one: the number of robots beyond is the same before and after.
template <typename IsBeyond>
void PartCheck::addOpposite(std::uint32_t from, std::uint32_t to, IsBeyond is_beyond,
                            SolvabilityVerdict& verdict) const {
  verdict.robots = {at_start_[from]};
  for (std::uint32_t rank = blanks_; rank < tree_.size(); ++rank) {
    const std::uint32_t goal = tables_.goal_rank[at_start_[rank]];
    if (is_beyond(rank) != is_beyond(to) || is_beyond(goal) != is_beyond(from)) continue;
    verdict.robots.push_back(at_start_[rank]);
    return;
  }
}

/// @pre no part of the component is empty, and every robot stays in its loop.
std::optional<SolvabilityVerdict> PartCheck::compareFullLoops() const {
  std::map<std::uint32_t, std::vector<std::uint32_t>> ranks_by_loop;
  for (std::uint32_t rank = 0; rank < tree_.size(); ++rank) {
    const std::uint32_t loop = tables_.structure.loopOf(tree_.vertices[rank]);
    if (loop != BridgeStructure::kNoLoop) ranks_by_loop[loop].push_back(rank);
  }
  for (const auto& [id, ranks] : ranks_by_loop) {
    const Loop& loop = tables_.structure.loops()[id];
    std::optional<SolvabilityVerdict> refusal;
    if (loop.is_ring) {
      refusal = compareRing(ranks);
    } else if (!loop.has_even_cycle) {
      refusal = compareParity(ranks);
    }
    if (refusal) return refusal;
  }
  return std::nullopt;
}

/// @pre the ranks are a ring's: in preorder they go round it, whatever hangs on it.
std::optional<SolvabilityVerdict> PartCheck::compareRing(
    const std::vector<std::uint32_t>& ranks) const {
  std::vector<std::uint32_t> starts;
  std::vector<std::uint32_t> goals;
  for (const std::uint32_t rank : ranks) {
    if (at_start_[rank] != kNoRobot) starts.push_back(at_start_[rank]);
    if (at_goal_[rank] != kNoRobot) goals.push_back(at_goal_[rank]);
  }
  const auto overtaking = findOvertaking(starts, goals);
  if (!overtaking) return std::nullopt;
  SolvabilityVerdict verdict = refuse(RefusalKind::kCycleOrder, std::nullopt);
  if (!part_.is_ring) verdict.blanks_needed = 1;
  verdict.robots.assign(overtaking->begin(), overtaking->end());
  for (const std::uint32_t rank : ranks) verdict.vertices.push_back(tree_.vertices[rank]);
  return verdict;
}

std::optional<SolvabilityVerdict> PartCheck::compareParity(
    const std::vector<std::uint32_t>& ranks) const {
  std::vector<std::uint32_t> starts;
  std::vector<std::uint32_t> goals;
  SolvabilityVerdict verdict = refuse(RefusalKind::kParity, 1);
  for (const std::uint32_t rank : ranks) {
    starts.push_back(at_start_[rank]);
    goals.push_back(at_goal_[rank]);
    if (starts.back() != goals.back()) verdict.robots.push_back(starts.back());
    verdict.vertices.push_back(tree_.vertices[rank]);
  }
  if (!isOddPermutation(starts, goals)) return std::nullopt;
  return verdict;
}

}  // namespace split_mapf
