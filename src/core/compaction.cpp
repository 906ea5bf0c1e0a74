#include "split_mapf/core/compaction.h"

#include <algorithm>
#include <vector>

namespace split_mapf {
namespace {

constexpr std::uint32_t kNobody = 0xffffffffU;

/// An unbroken visit of a robot to a vertex.
struct Visit {
  Vertex vertex;
  std::uint32_t rank;  // how many visits to the vertex come before
};

/// The visits of each robot, ranked by the order in which the plan makes them.
std::vector<std::vector<Visit>> rankVisits(const Plan& plan, std::uint32_t vertices) {
  std::vector<std::vector<Visit>> visits(plan.paths.size());
  std::vector<std::uint32_t> count(vertices, 0);
  std::uint32_t longest = 0;
  for (std::size_t i = 0; i < plan.paths.size(); ++i) {
    const Vertex start = plan.paths[i].front();
    visits[i].push_back({start, count[start]++});
    longest = std::max(longest, static_cast<std::uint32_t>(plan.paths[i].size()));
  }
  for (std::uint32_t t = 1; t < longest; ++t) {
    for (std::size_t i = 0; i < plan.paths.size(); ++i) {
      const Path& path = plan.paths[i];
      if (t >= path.size() || path[t] == path[t - 1]) continue;
      visits[i].push_back({path[t], count[path[t]]++});
    }
  }
  return visits;
}

/// Plays the visits as early as their ranks allow.
class Replay {
 public:
  Replay(const Plan& plan, std::uint32_t vertices)
      : visits_(rankVisits(plan, vertices)),
        at_(plan.paths.size(), 0),
        decision_(plan.paths.size(), Decision::kOpen),
        ended_(vertices, 0),
        occupant_(vertices, kNobody) {
    result_.paths.resize(plan.paths.size());
    for (std::uint32_t i = 0; i < plan.paths.size(); ++i) {
      occupant_[visits_[i].front().vertex] = i;
      result_.paths[i].push_back(visits_[i].front().vertex);
      if (visits_[i].size() > 1) travelling_.push_back(i);
    }
  }

  Plan run() {
    while (!travelling_.empty()) step();
    return std::move(result_);
  }

 private:
  enum class Decision { kOpen, kMove, kStay };

  const Visit& nextOf(std::uint32_t robot) const { return visits_[robot][at_[robot] + 1]; }

  void step() {
    for (const std::uint32_t robot : travelling_) decision_[robot] = Decision::kOpen;
    for (const std::uint32_t robot : travelling_) decide(robot);
    for (const std::uint32_t robot : travelling_) {
      if (decision_[robot] == Decision::kMove) leave(robot);
    }
    for (const std::uint32_t robot : travelling_) enter(robot);
    travelling_.erase(std::remove_if(travelling_.begin(), travelling_.end(),
                                     [this](std::uint32_t robot) {
                                       return at_[robot] + 1 == visits_[robot].size();
                                     }),
                      travelling_.end());
  }

  /// Follows the chain of robots that wait for each other's cells up to one that is decided, is
  /// free to go, or closes a ring.
  void decide(std::uint32_t robot) {
    chain_.clear();
    Decision decision = Decision::kOpen;
    for (std::uint32_t i = robot; decision == Decision::kOpen;) {
      if (decision_[i] != Decision::kOpen) {
        decision = decision_[i];
        break;
      }
      chain_.push_back(i);
      const Visit& next = nextOf(i);
      if (ended_[next.vertex] == next.rank) {
        decision = Decision::kMove;
      } else if (ended_[next.vertex] + 1 != next.rank || occupant_[next.vertex] == kNobody ||
                 at_[occupant_[next.vertex]] + 1 == visits_[occupant_[next.vertex]].size()) {
        decision = Decision::kStay;
      } else {
        i = occupant_[next.vertex];
        if (i == robot) decision = Decision::kMove;  // a ring: all move together
      }
    }
    for (const std::uint32_t i : chain_) decision_[i] = decision;
  }

  void leave(std::uint32_t robot) {
    const Vertex v = visits_[robot][at_[robot]].vertex;
    ++ended_[v];
    occupant_[v] = kNobody;
  }

  void enter(std::uint32_t robot) {
    if (decision_[robot] == Decision::kMove) {
      ++at_[robot];
      occupant_[visits_[robot][at_[robot]].vertex] = robot;
    }
    result_.paths[robot].push_back(visits_[robot][at_[robot]].vertex);
  }

  std::vector<std::vector<Visit>> visits_;
  std::vector<std::size_t> at_;            // robot -> its current visit
  std::vector<Decision> decision_;         // robot -> what it does in this step
  std::vector<std::uint32_t> ended_;       // vertex -> visits that are over
  std::vector<std::uint32_t> occupant_;    // vertex -> robot there
  std::vector<std::uint32_t> travelling_;  // robots that have visits to come
  std::vector<std::uint32_t> chain_;
  Plan result_;
};

}  // namespace

Plan compact(const Plan& plan, std::uint32_t vertices) { return Replay(plan, vertices).run(); }

}  // namespace split_mapf
