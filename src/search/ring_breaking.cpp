#include "search/ring_breaking.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "search/gap_search.h"
#include "search/stay.h"
#include "split_mapf/core/precedence.h"

namespace split_mapf {
namespace {

constexpr int kRounds = 5;
// Steps before a ring from which a robot of it looks for another way: the way up to there is as
// good as it was, and most of what a search from the start would look at lies there.
constexpr std::uint32_t kReach = 16;
// Steps by which a robot that steps aside shortly before a ring may arrive later: who must wait for
// longer looks for another way from its start. How far a search looks ahead costs time and memory.
constexpr std::uint32_t kMostDelay = 64;

/// Where the robot goes that leaves a vertex in step t; kNoVertex: none does.
Vertex leadsTo(const ReservationTable& placed, Vertex v, std::uint32_t t) {
  if (!placed.isTaken(v, t - 1)) return kNoVertex;
  const std::vector<Stay>& stays = placed.at(v);
  const auto stay = std::partition_point(stays.begin(), stays.end(),
                                         [t](const Stay& before) { return before.end < t; });
  return stay != stays.end() && stay->end == t ? stay->next : kNoVertex;
}

/// One call of breakRings().
class RingBreaking {
 public:
  RingBreaking(const Instance& instance, Plan plan, const Departures& departures,
               const Deadline& deadline, std::uint64_t most)
      : instance_(instance),
        departures_(departures),
        deadline_(deadline),
        most_(most),
        plan_(std::move(plan)),
        table_(instance.graph().size(), plan_),
        search_(instance.graph()) {}

  const SearchWork& work() const { return work_; }

  Plan run(Precedence order) {
    for (int round = 0; round < kRounds; ++round) {
      if (round > 0) order = Precedence(plan_, instance_.graph().size());
      bool broken = false;
      for (const Ring& ring : findRings(order)) {
        if (work_.states() >= most_) return std::move(plan_);
        if (stillRotates(order, ring)) broken = breakOne(order, ring) || broken;
      }
      if (!broken || deadline_.expired()) break;
    }
    return std::move(plan_);
  }

 private:
  /// A robot of several rings may have got another path already.
  bool stillRotates(const Precedence& order, const Ring& ring) const {
    for (const VisitId event : ring) {
      const Path& path = plan_.paths[order[event].robot];
      const std::uint32_t t = order[event].step;
      if (positionAt(path, t) != order[event].vertex) return false;
      if (positionAt(path, t - 1) != order[event - 1].vertex) return false;
    }
    return true;
  }

  /// Robots look for other ways first from shortly before the ring, then from their starts.
  bool breakOne(const Precedence& order, const Ring& ring) {
    return breakFrom(order, ring, kReach) || breakFrom(order, ring, kForever);
  }

  bool breakFrom(const Precedence& order, const Ring& ring, std::uint32_t reach) {
    Path best;
    std::uint32_t robot = 0;
    // By how much more than before somebody may lose, and be the best one.
    std::uint32_t slack = kForever - 1;
    for (const VisitId event : ring) {
      if (!best.empty() && slack == 0) break;
      const std::uint32_t own = order[event].robot;
      const auto cost = static_cast<std::uint32_t>(plan_.paths[own].size() - 1);
      const bool from_start = keptOf(order[event], kReach) == keptOf(order[event], kForever);
      if (reach == kForever && from_start) continue;  // it has looked already, and for all time
      const bool for_all_time = reach == kForever || from_start;
      const std::uint32_t most = for_all_time ? kForever - 1 : cost + kMostDelay;
      const std::uint32_t latest = best.empty() ? most : cost + slack - 1;
      Path path = pathWithout(order[event], reach, latest);
      if (path.empty()) continue;
      slack = std::max(static_cast<std::uint32_t>(path.size() - 1), cost) - cost;
      best = std::move(path);
      robot = own;
    }
    if (best.empty()) return false;
    table_.remove(robot, plan_.paths[robot]);
    plan_.paths[robot] = std::move(best);
    table_.insert(robot, plan_.paths[robot]);
    return true;
  }

  /// The steps of its path that a robot keeps which looks for another way around a visit.
  std::uint32_t keptOf(const Visit& visit, std::uint32_t reach) const {
    const Path& own = plan_.paths[visit.robot];
    return std::max(departures_(visit.robot), keptUntil(own, visit.step - 1, reach));
  }

  /// The earliest path on which the robot does not come to the vertex at the ring's step.
  Path pathWithout(const Visit& visit, std::uint32_t reach, std::uint32_t latest_arrival) {
    const Path& own = plan_.paths[visit.robot];
    const std::uint32_t kept = keptOf(visit, reach);
    table_.removeTail(visit.robot, own, kept);
    table_.toggleStep(visit.vertex, visit.step);
    const HeldDistances distances = instance_.distances(visit.robot);
    const GapQuery query = queryFrom(own, kept, *distances, table_, latest_arrival);
    GapAnswer answer = search_.search(query, deadline_);
    work_ += answer.work;
    table_.toggleStep(visit.vertex, visit.step);
    table_.insertTail(visit.robot, own, kept);
    Path& path = answer.path;
    if (path.empty()) return {};
    std::copy_n(own.begin(), kept, path.begin());
    while (path.size() > 1 && path[path.size() - 2] == path.back()) path.pop_back();
    return std::move(path);
  }

  const Instance& instance_;
  const Departures& departures_;
  const Deadline& deadline_;
  const std::uint64_t most_;
  Plan plan_;
  ReservationTable table_;
  GapSearch search_;
  SearchWork work_;
};

}  // namespace

Plan breakRings(const Instance& instance, Plan plan, const Departures& departures,
                const Deadline& deadline, SearchWork* work, std::uint64_t most) {
  Precedence order(plan, instance.graph().size());
  if (findRings(order).empty()) return plan;
  RingBreaking breaking(instance, std::move(plan), departures, deadline, most);
  Plan broken = breaking.run(std::move(order));
  if (work != nullptr) *work += breaking.work();
  return broken;
}

bool closesRing(const ReservationTable& placed, const Path& path, std::uint32_t from) {
  for (std::uint32_t t = from + 1; t < path.size(); ++t) {
    if (path[t] == path[t - 1]) continue;
    // No two come to one vertex: who follows the leaders comes back to this robot, or to an end.
    Vertex ahead = leadsTo(placed, path[t], t);
    while (ahead != kNoVertex && ahead != path[t]) ahead = leadsTo(placed, ahead, t);
    if (ahead != kNoVertex) return true;
  }
  return false;
}

}  // namespace split_mapf
