#include "solver/ecbs/cardinality.h"

#include <algorithm>
#include <utility>

namespace split_mapf {
namespace {

// Wider diagrams, of robots with many steps to spare, have no bottleneck where one would help.
constexpr std::size_t kMostStates = 20000;
constexpr std::size_t kMostKept = std::size_t{1} << 23;

/// Whether the bottlenecks take the robot into the conflict, whichever path it takes.
bool forcedInto(const Conflict& conflict, std::uint32_t robot, const Bottlenecks& bottlenecks) {
  if (bottlenecks.empty()) return false;
  const std::size_t last = bottlenecks.size() - 1;
  const auto at = [&](std::size_t step) { return bottlenecks[std::min(step, last)]; };
  const std::size_t step = conflict.step;
  switch (conflict.kind) {
    case Conflict::Kind::kVertex:
      return at(step) == conflict.vertex;
    case Conflict::Kind::kSwap: {
      const bool forth = robot == conflict.first;
      return at(step - 1) == (forth ? conflict.vertex : conflict.other) &&
             at(step) == (forth ? conflict.other : conflict.vertex);
    }
    case Conflict::Kind::kTarget:
      // Its branch forbids the vertex from that step on.
      for (std::size_t t = step; t <= last; ++t) {
        if (bottlenecks[t] == conflict.vertex) return true;
      }
      return false;
  }
  return false;
}

}  // namespace

Bottlenecks BottleneckFinder::find(std::uint32_t robot, std::uint32_t length,
                                   const RobotConstraints& constraints) {
  if (!spread(robot, length, constraints)) return {};
  // Back from the goal, each level keeps the states that lead to a kept one of the next.
  Bottlenecks bottlenecks(length + 1, kNoVertex);
  for (std::uint32_t step = length + 1; step-- > 0;) {
    const auto begin = states_.begin() + static_cast<std::ptrdiff_t>(level_begin_[step]);
    auto end = states_.begin() + static_cast<std::ptrdiff_t>(level_begin_[step + 1]);
    if (step < length) {
      end =
          std::remove_if(begin, end, [&](Vertex v) { return !leadsOn(v, step + 1, constraints); });
    }
    if (begin == end) return {};
    if (end - begin == 1) bottlenecks[step] = *begin;
    ++level_;
    for (auto v = begin; v != end; ++v) mark_[*v] = level_;
  }
  return bottlenecks;
}

bool BottleneckFinder::spread(std::uint32_t robot, std::uint32_t length,
                              const RobotConstraints& constraints) {
  const HeldDistances held = instance_.distances(robot);
  const DistanceTable& distances = *held;
  const Vertex goal = distances.goal();
  if (distances(instance_.start(robot)) > length) return false;
  states_.assign(1, instance_.start(robot));
  level_begin_.assign({0, 1});
  for (std::uint32_t step = 1; step <= length; ++step) {
    ++level_;  // a vertex marked for it is in the level, or must not be
    for (const RobotConstraints::VertexBan& ban : constraints.vertex_bans) {
      const bool stays_out = step == length && ban.vertex == goal && ban.end > length;
      if ((ban.begin <= step && step < ban.end) || stays_out) mark_[ban.vertex] = level_;
    }
    if (step + 1 == length) mark_[goal] = level_;
    for (std::size_t i = level_begin_[step - 1]; i < level_begin_[step]; ++i) {
      spreadFrom(states_[i], step, length - step, distances, constraints);
    }
    expansions_ += states_.size() - level_begin_[step];
    level_begin_.push_back(states_.size());
    if (level_begin_[step] == level_begin_[step + 1] || states_.size() > kMostStates) return false;
  }
  return true;
}

void BottleneckFinder::spreadFrom(Vertex v, std::uint32_t step, std::uint32_t most_left,
                                  const DistanceTable& distances,
                                  const RobotConstraints& constraints) {
  const auto spread_to = [&](Vertex to) {
    if (mark_[to] == level_ || distances(to) > most_left) return;
    if (constraints.bansMove(v, to, step)) return;
    mark_[to] = level_;
    states_.push_back(to);
  };
  spread_to(v);
  for (const Vertex to : instance_.graph().neighbours(v)) spread_to(to);
}

bool BottleneckFinder::leadsOn(Vertex v, std::uint32_t step,
                               const RobotConstraints& constraints) const {
  const auto kept = [&](Vertex to) {
    return mark_[to] == level_ && !constraints.bansMove(v, to, step);
  };
  const VertexRange neighbours = instance_.graph().neighbours(v);
  return kept(v) || std::any_of(neighbours.begin(), neighbours.end(), kept);
}

ConflictRanking Cardinality::rank(const TreeNode& node, const Robots& robots) {
  ConflictRanking ranking;
  matched_.assign(instance_.robots(), false);
  std::pair<int, std::uint32_t> best{3, 0};
  for (std::size_t i = 0; i < node.conflicts.size(); ++i) {
    if (deadline_.expired()) break;
    const Conflict& conflict = node.conflicts[i];
    const bool first = isCardinalFor(conflict.first, conflict, robots);
    const bool second = isCardinalFor(conflict.second, conflict, robots);
    const std::pair<int, std::uint32_t> mine{2 - int{first} - int{second}, conflict.step};
    if (mine < best) {
      best = mine;
      ranking.chosen = i;
    }
    if (!first || !second || matched_[conflict.first] || matched_[conflict.second]) continue;
    matched_[conflict.first] = matched_[conflict.second] = true;
    ++ranking.surplus;
  }
  return ranking;
}

bool Cardinality::isCardinalFor(std::uint32_t robot, const Conflict& conflict,
                                const Robots& robots) {
  const std::uint32_t length = robots.bound_of[robot];
  // Its arrival is all that a target conflict is about.
  if (conflict.kind == Conflict::Kind::kTarget && robot == conflict.second) {
    return length <= conflict.step;
  }
  return forcedInto(conflict, robot, bottlenecksOf(robot, length, robots.constrained_at[robot]));
}

const Bottlenecks& Cardinality::bottlenecksOf(std::uint32_t robot, std::uint32_t length,
                                              std::uint32_t constrained_at) {
  if (kept_ > kMostKept) {
    known_.clear();
    kept_ = 0;
  }
  const bool free = constrained_at == TreeNode::kNoParent;
  const auto [known, is_new] =
      known_.try_emplace(free ? robot : std::uint64_t{instance_.robots()} + constrained_at);
  if (!is_new) return known->second;
  constraints_.clear();
  if (!free) tree_.gatherConstraints(constrained_at, robot, constraints_);
  known->second = finder_.find(robot, length, constraints_);
  kept_ += known->second.size() + 1;
  return known->second;
}

}  // namespace split_mapf
