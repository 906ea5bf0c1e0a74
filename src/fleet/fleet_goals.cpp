#include "fleet/fleet_goals.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace split_mapf {
namespace {

/// Visits what can be reached from a vertex, nearest first, until `take` says that it is enough.
template <typename Take>
void flood(const Graph& graph, Vertex from, std::vector<std::uint32_t>& seen, std::uint32_t mark,
           const Take& take) {
  std::vector<Vertex> queue = {from};
  seen[from] = mark;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    if (take(queue[i])) return;
    for (const Vertex next : graph.neighbours(queue[i])) {
      if (seen[next] == mark) continue;
      seen[next] = mark;
      queue.push_back(next);
    }
  }
}

/// The number of the connected part in which each vertex lies, from 1 on.
std::vector<std::uint32_t> partsOf(const Graph& graph) {
  std::vector<std::uint32_t> parts(graph.size(), 0);
  std::uint32_t part = 0;
  for (Vertex v = 0; v < graph.size(); ++v) {
    if (parts[v] != 0) continue;
    flood(graph, v, parts, ++part, [](Vertex) { return false; });
  }
  return parts;
}

/// One call of chooseGoals().
class Choice {
 public:
  Choice(const Grid& open, const std::vector<bool>& blocked, const std::vector<Vertex>& starts,
         const std::vector<bool>& shunned)
      : graph_(open.graph()),
        blocked_(blocked),
        shunned_(shunned),
        starts_(starts),
        parts_(partsOf(graph_)),
        seen_(graph_.size(), 0) {}

  FleetGoals run(const std::vector<Vertex>& wanted, const std::vector<bool>& takes_part,
                 const std::vector<GoalFault>& known) {
    chosen_.goals = starts_;
    chosen_.faults = known;
    wanted_by_.assign(graph_.size(), kNobody);
    for (std::uint32_t robot = 0; robot < starts_.size(); ++robot) {
      if (takes_part[robot]) send(robot, wanted[robot]);
    }
    // Whoever closes another one's goal makes that one look for a place, too.
    for (bool changed = true; changed;) {
      changed = false;
      park();
      for (std::uint32_t robot = 0; robot < starts_.size(); ++robot) {
        const Vertex goal = chosen_.goals[robot];
        const std::uint32_t other = wanted_by_[goal];
        if (other == kNobody || other == robot) continue;
        chosen_.faults[other] = GoalFault::kBlocked;
        wanted_by_[goal] = kNobody;
        chosen_.goals[other] = starts_[other];
        changed = true;
      }
    }
    return std::move(chosen_);
  }

 private:
  void send(std::uint32_t robot, Vertex goal) {
    GoalFault& fault = chosen_.faults[robot];
    if (fault != GoalFault::kNone) return;
    if (blocked_[goal]) {
      fault = GoalFault::kBlocked;
    } else if (parts_[starts_[robot]] != parts_[goal]) {
      fault = GoalFault::kNoWay;
    } else {
      chosen_.goals[robot] = goal;
      wanted_by_[goal] = robot;
    }
  }

  bool isShunned(Vertex v) const { return !shunned_.empty() && shunned_[v]; }

  /// Robots without a goal stay where nobody is wanted, or go to the nearest vertex where nobody is
  /// wanted or begins.
  void park() {
    std::vector<bool> taken(graph_.size(), false);
    for (std::uint32_t robot = 0; robot < starts_.size(); ++robot) {
      taken[starts_[robot]] = true;
      taken[chosen_.goals[robot]] = true;
    }
    for (std::uint32_t robot = 0; robot < starts_.size(); ++robot) {
      const bool lacks_goal = chosen_.faults[robot] != GoalFault::kNone;
      const Vertex goal = chosen_.goals[robot];
      if (!lacks_goal || (wanted_by_[goal] == kNobody && !isShunned(goal))) continue;
      flood(graph_, starts_[robot], seen_, ++mark_, [&](Vertex v) {
        if (taken[v] || blocked_[v] || isShunned(v)) return false;
        chosen_.goals[robot] = v;
        taken[v] = true;
        return true;
      });
    }
  }

  static constexpr std::uint32_t kNobody = 0xffffffffU;

  const Graph& graph_;
  const std::vector<bool>& blocked_;
  const std::vector<bool>& shunned_;
  const std::vector<Vertex>& starts_;
  std::vector<std::uint32_t> parts_;
  std::vector<std::uint32_t> seen_;
  std::uint32_t mark_ = 0;
  std::vector<std::uint32_t> wanted_by_;  // by vertex
  FleetGoals chosen_;
};

}  // namespace

FleetGoals chooseGoals(const Grid& open, const std::vector<bool>& blocked,
                       const std::vector<Vertex>& starts, const std::vector<Vertex>& wanted,
                       const std::vector<bool>& takes_part, const std::vector<GoalFault>& known,
                       const std::vector<bool>& shunned) {
  return Choice(open, blocked, starts, shunned).run(wanted, takes_part, known);
}

}  // namespace split_mapf
