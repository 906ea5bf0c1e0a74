#include "search/straighten.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "parallel/thread_team.h"
#include "search/apart.h"
#include "search/reservation_table.h"
#include "search/straight_search.h"

namespace split_mapf {
namespace {

// A second one gains where others made room, a third next to nothing.
constexpr int kPasses = 2;
// Robots that are searched for side by side; not the number of threads, as the plan must not depend
// on that.
constexpr std::uint32_t kBatch = 32;
// A table for each takes memory.
constexpr std::uint32_t kMostThreads = 8;

/// One call of straighten().
class Straightening {
 public:
  Straightening(const Instance& instance, const HeadingGraph& graph, Plan plan,
                const LentThreads& threads, const Deadline& deadline)
      : instance_(instance),
        deadline_(deadline),
        plan_(std::move(plan)),
        team_(threads.atMost(kMostThreads)),
        tables_(team_.threads(), ReservationTable(instance.graph().size(), plan_)),
        searches_(tables_.size(), {StraightSearch(graph, instance.graph().size())}) {}

  Plan run() {
    for (int pass = 0; pass < kPasses; ++pass) {
      for (std::uint32_t first = 0; first < instance_.robots(); first += kBatch) {
        if (deadline_.expired()) return std::move(plan_);
        straightenBatch(first, std::min(kBatch, instance_.robots() - first));
      }
    }
    return std::move(plan_);
  }

 private:
  struct Change {
    std::uint32_t robot;
    Path before;
  };

  Path search(std::uint32_t robot, std::uint32_t member) {
    const Path& own = plan_.paths[robot];
    if (own.size() < 3) return {};
    ReservationTable& table = tables_[member];
    table.remove(robot, own);
    const HeldDistances distances = instance_.distances(robot);
    Path path = searches_[member].value.search(own, *distances, table);
    table.insert(robot, own);
    return path;
  }

  void straightenBatch(std::uint32_t first, std::uint32_t size) {
    found_.resize(size);
    team_.forEach(size, [&](std::uint32_t i, std::uint32_t member) {
      found_[i] = search(first + i, member);
    });
    changes_.clear();
    for (std::uint32_t i = 0; i < size; ++i) {
      // Who meets another of the batch on its new path looks again.
      if (!take(first + i, std::move(found_[i]))) take(first + i, search(first + i, 0));
    }
    team_.forEach(static_cast<std::uint32_t>(tables_.size() - 1),
                  [&](std::uint32_t other, std::uint32_t) { repeatChanges(tables_[other + 1]); });
  }

  /// @return false if somebody is in the way.
  bool take(std::uint32_t robot, Path path) {
    if (path.empty()) return true;
    if (!tables_.front().exchange(robot, plan_.paths[robot], path)) return false;
    changes_.push_back({robot, std::move(path)});
    return true;
  }

  void repeatChanges(ReservationTable& table) const {
    for (const Change& change : changes_) table.remove(change.robot, change.before);
    for (const Change& change : changes_) table.insert(change.robot, plan_.paths[change.robot]);
  }

  const Instance& instance_;
  const Deadline& deadline_;
  Plan plan_;
  ThreadTeam team_;
  std::vector<ReservationTable> tables_;         // of everybody, one a thread
  std::vector<Apart<StraightSearch>> searches_;  // one a thread
  std::vector<Path> found_;
  std::vector<Change> changes_;  // of the batch
};

}  // namespace

std::uint32_t countTurns(const Grid& grid, const Path& path) {
  std::uint32_t turns = 0;
  Cell before = {0, 0};  // the last move
  for (std::size_t t = 1; t < path.size(); ++t) {
    if (path[t] == path[t - 1]) continue;
    const Cell a = grid.cellOf(path[t - 1]);
    const Cell b = grid.cellOf(path[t]);
    const Cell now = {b.x - a.x, b.y - a.y};
    const std::int32_t along = before.x * now.x + before.y * now.y;
    const bool moved = before != Cell{0, 0};
    if (moved && along <= 0) turns += along < 0 ? 2 : 1;
    before = now;
  }
  return turns;
}

Plan straighten(const Instance& instance, Plan plan, const LentThreads& threads,
                const Deadline& deadline) {
  const HeadingGraph graph(instance.grid());
  if (!graph.isValid()) return plan;
  return Straightening(instance, graph, std::move(plan), threads, deadline).run();
}

}  // namespace split_mapf
