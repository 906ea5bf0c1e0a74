#include "search/ring_breaking.h"

#include <utility>
#include <vector>

#include "search/gap_search.h"
#include "search/reservation_table.h"
#include "split_mapf/core/precedence.h"

namespace split_mapf {
namespace {

constexpr int kRounds = 5;

/// One call of breakRings().
class RingBreaking {
 public:
  RingBreaking(const Instance& instance, Plan plan, const Departures& departures,
               const Deadline& deadline)
      : instance_(instance),
        departures_(departures),
        deadline_(deadline),
        plan_(std::move(plan)),
        table_(instance.graph().size(), plan_),
        search_(instance.graph()) {}

  Plan run() {
    for (int round = 0; round < kRounds; ++round) {
      const Precedence order(plan_, instance_.graph().size());
      bool broken = false;
      for (const Ring& ring : findRings(order)) {
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

  bool breakOne(const Precedence& order, const Ring& ring) {
    Path best;
    std::uint32_t robot = 0;
    std::uint32_t least = 0;
    for (const VisitId event : ring) {
      Path path = pathWithout(order[event]);
      if (path.empty()) continue;
      const std::uint32_t own = order[event].robot;
      const auto loss = static_cast<std::uint32_t>(path.size() + instance_.robots()) -
                        static_cast<std::uint32_t>(plan_.paths[own].size());
      if (!best.empty() && loss >= least) continue;
      best = std::move(path);
      robot = own;
      least = loss;
    }
    if (best.empty()) return false;
    table_.remove(robot, plan_.paths[robot]);
    plan_.paths[robot] = std::move(best);
    table_.insert(robot, plan_.paths[robot]);
    return true;
  }

  /// The earliest path on which the robot does not come to the vertex at the ring's step.
  Path pathWithout(const Visit& visit) {
    const Path& own = plan_.paths[visit.robot];
    table_.remove(visit.robot, own);
    table_.toggleStep(visit.vertex, visit.step);
    GapQuery query;
    query.start = own.front();
    const HeldDistances distances = instance_.distances(visit.robot);
    query.distances = &*distances;
    query.placed = &table_;
    query.departure = departures_(visit.robot);
    GapAnswer answer = search_.search(query, deadline_);
    table_.toggleStep(visit.vertex, visit.step);
    table_.insert(visit.robot, own);
    Path& path = answer.path;
    while (path.size() > 1 && path[path.size() - 2] == path.back()) path.pop_back();
    return std::move(path);
  }

  const Instance& instance_;
  const Departures& departures_;
  const Deadline& deadline_;
  Plan plan_;
  ReservationTable table_;
  GapSearch search_;
};

}  // namespace

Plan breakRings(const Instance& instance, Plan plan, const Departures& departures,
                const Deadline& deadline) {
  return RingBreaking(instance, std::move(plan), departures, deadline).run();
}

}  // namespace split_mapf
