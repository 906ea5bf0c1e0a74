#include "search/straighten.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "parallel/thread_team.h"
#include "search/apart.h"
#include "search/occupancy_by_steps.h"
#include "search/straight_search.h"

namespace split_mapf {
namespace {

// Where turns lie differs from pass to pass, so that robots try other places. Each pass more would
// take a third of the time more, for 2 % of what plans take longer as robots turn.
constexpr std::array<TurnsLie, 3> kPasses = {TurnsLie::kEarly, TurnsLie::kLate, TurnsLie::kEarly};
// Robots that are searched for side by side; not the number of threads, as the plan must not depend
// on that.
constexpr std::uint32_t kBatch = 32;

/// One call of straighten().
class Straightening {
 public:
  Straightening(const Instance& instance, const HeadingGraph& graph, Plan plan,
                const LentThreads& threads, const Deadline& deadline)
      : instance_(instance),
        deadline_(deadline),
        plan_(std::move(plan)),
        table_(graph, instance.graph().size(), plan_),
        team_(threads.atMost(kBatch)),
        searches_(team_.threads(), {StraightSearch(graph, instance.graph().size())}) {}

  Plan run() {
    for (TurnsLie pass : kPasses) {
      for (std::uint32_t first = 0; first < instance_.robots(); first += kBatch) {
        if (deadline_.expired()) return std::move(plan_);
        straightenBatch(first, std::min(kBatch, instance_.robots() - first), pass);
      }
    }
    return std::move(plan_);
  }

 private:
  Path search(std::uint32_t robot, TurnsLie pass, std::uint32_t member) {
    const Path& own = plan_.paths[robot];
    if (own.size() < 3) return {};
    const HeldDistances distances = instance_.distances(robot);
    return searches_[member].value.search(own, *distances, table_, pass);
  }

  void straightenBatch(std::uint32_t first, std::uint32_t size, TurnsLie pass) {
    found_.resize(size);
    team_.forEach(size, [&](std::uint32_t i, std::uint32_t member) {
      found_[i] = search(first + i, pass, member);
    });
    for (std::uint32_t i = 0; i < size; ++i) {
      // Who meets another of the batch on its new path looks again.
      if (!take(first + i, std::move(found_[i]))) take(first + i, search(first + i, pass, 0));
    }
  }

  /// @return false if somebody is in the way.
  bool take(std::uint32_t robot, Path path) {
    Path& own = plan_.paths[robot];
    return path.empty() || path == own || table_.exchange(own, path);
  }

  const Instance& instance_;
  const Deadline& deadline_;
  Plan plan_;
  OccupancyBySteps table_;
  ThreadTeam team_;
  std::vector<Apart<StraightSearch>> searches_;  // one a thread
  std::vector<Path> found_;
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
