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
// Of pairs; a second one gains next to nothing.
constexpr int kPairPasses = 1;
// Robots that are asked to make room, one after the other, for one that would turn less. More gain
// little, and most time goes into those that cannot.
constexpr std::size_t kMostAsked = 2;
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
        searches_(tables_.size(), {StraightSearch(graph, instance.graph().size())}),
        nobody_(instance.graph().size()) {}

  Plan run() {
    for (int pass = 0; pass < kPasses + kPairPasses; ++pass) {
      for (std::uint32_t first = 0; first < instance_.robots(); first += kBatch) {
        if (deadline_.expired()) return std::move(plan_);
        const std::uint32_t size = std::min(kBatch, instance_.robots() - first);
        changes_.clear();
        if (pass < kPasses) {
          straightenBatch(first, size);
        } else {
          straightenPairs(first, size);
        }
        team_.forEach(
            static_cast<std::uint32_t>(tables_.size() - 1),
            [&](std::uint32_t other, std::uint32_t) { repeatChanges(tables_[other + 1]); });
      }
    }
    return std::move(plan_);
  }

 private:
  struct Change {
    std::uint32_t robot;
    Path before;
  };
  /// A path with fewer turns, and the path of the robot that makes room for it.
  struct Pair {
    std::uint32_t other = 0;
    Path path;
    Path path_of_other;
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
    for (std::uint32_t i = 0; i < size; ++i) {
      // Who meets another of the batch on its new path looks again.
      if (!take(first + i, std::move(found_[i]))) take(first + i, search(first + i, 0));
    }
  }

  /// @return false if somebody is in the way.
  bool take(std::uint32_t robot, Path path) {
    if (path.empty()) return true;
    if (!tables_.front().exchange(robot, plan_.paths[robot], path)) return false;
    changes_.push_back({robot, std::move(path)});
    return true;
  }

  std::uint32_t turnsOf(const Path& path) const { return countTurns(instance_.grid(), path); }

  /// Who is in the way of the path that the robot would take alone is asked to make room, for no
  /// more turns than that saves.
  Pair searchPair(std::uint32_t robot, std::uint32_t member) {
    const Path& own = plan_.paths[robot];
    if (own.size() < 3) return {};
    const HeldDistances distances = instance_.distances(robot);
    const Path alone = searches_[member].value.search(own, *distances, nobody_);
    if (alone.empty()) return {};
    ReservationTable& table = tables_[member];
    table.remove(robot, own);
    const std::vector<std::uint32_t> others = robotsInTheWay(table.paths(), alone);
    Pair pair;
    for (std::size_t i = 0; i < std::min(others.size(), kMostAsked) && pair.path.empty(); ++i) {
      table.remove(others[i], plan_.paths[others[i]]);
      pair = searchPairWith(others[i], robot, *distances, member);
      table.insert(others[i], plan_.paths[others[i]]);
    }
    table.insert(robot, own);
    return pair;
  }

  /// @pre neither of the two is in the table.
  Pair searchPairWith(std::uint32_t other, std::uint32_t robot, const DistanceTable& distances,
                      std::uint32_t member) {
    const Path& own = plan_.paths[robot];
    const Path& own_of_other = plan_.paths[other];
    ReservationTable& table = tables_[member];
    StraightSearch& search = searches_[member].value;
    Pair pair{other, search.search(own, distances, table), {}};
    if (pair.path.empty()) return {};
    const std::uint32_t saved = turnsOf(own) - turnsOf(pair.path);
    table.insert(robot, pair.path);
    const HeldDistances distances_of_other = instance_.distances(other);
    pair.path_of_other = search.search(own_of_other, *distances_of_other, table, saved);
    const bool free = !pair.path_of_other.empty() && table.isFree(pair.path_of_other, 0);
    table.remove(robot, pair.path);
    return free ? std::move(pair) : Pair{};
  }

  void straightenPairs(std::uint32_t first, std::uint32_t size) {
    pairs_.resize(size);
    team_.forEach(size, [&](std::uint32_t i, std::uint32_t member) {
      pairs_[i] = searchPair(first + i, member);
    });
    for (std::uint32_t i = 0; i < size; ++i) takePair(first + i, std::move(pairs_[i]));
  }

  bool hasChanged(std::uint32_t robot) const {
    return std::any_of(changes_.begin(), changes_.end(),
                       [robot](const Change& change) { return change.robot == robot; });
  }

  /// Unless one of the two has changed in this batch, or somebody is in the way.
  void takePair(std::uint32_t robot, Pair pair) {
    if (pair.path.empty() || hasChanged(robot) || hasChanged(pair.other)) return;
    ReservationTable& table = tables_.front();
    Path& own = plan_.paths[robot];
    Path& own_of_other = plan_.paths[pair.other];
    table.remove(pair.other, own_of_other);
    if (table.exchange(robot, own, pair.path)) {
      if (table.isFree(pair.path_of_other, 0)) {
        own_of_other.swap(pair.path_of_other);
        changes_.push_back({robot, std::move(pair.path)});
        changes_.push_back({pair.other, std::move(pair.path_of_other)});
      } else {
        table.exchange(robot, own, pair.path);
      }
    }
    table.insert(pair.other, own_of_other);
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
  const ReservationTable nobody_;
  std::vector<Path> found_;
  std::vector<Pair> pairs_;
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
