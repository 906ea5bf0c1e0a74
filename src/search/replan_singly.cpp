#include "search/replan_singly.h"

#include <algorithm>
#include <deque>
#include <utility>
#include <vector>

#include "parallel/thread_team.h"
#include "search/apart.h"
#include "search/batch_size.h"
#include "search/gap_search.h"
#include "search/reservation_table.h"
#include "search/ring_breaking.h"

namespace split_mapf {
namespace {

// A table for each takes memory, and batches are too small for more.
constexpr std::uint32_t kMostThreads = 8;

std::vector<std::uint32_t> mostDelayedFirst(const Instance& instance,
                                            const std::vector<Path>& paths,
                                            const Departures& departures) {
  std::vector<std::size_t> delay(paths.size());
  std::vector<std::uint32_t> delayed;
  for (std::uint32_t i = 0; i < paths.size(); ++i) {
    delay[i] = paths[i].size() - 1 - departures.soonestArrival(instance, i);
    if (delay[i] > 0) delayed.push_back(i);
  }
  std::stable_sort(delayed.begin(), delayed.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return delay[a] > delay[b]; });
  return delayed;
}

/// One call of replanSingly() for a whole plan.
class BatchReplanning {
 public:
  BatchReplanning(const Instance& instance, Plan plan, const ReplanEffort& effort,
                  const Deadline& deadline)
      : instance_(instance),
        plan_(std::move(plan)),
        effort_(effort),
        deadline_(deadline),
        team_(effort.threads.atMost(kMostThreads)),
        own_(effort.table != nullptr
                 ? ReservationTable(0)
                 : tableOf(instance.graph().size(), plan_, effort.reserved, effort.headway)),
        table_(effort.table != nullptr ? *effort.table : own_),
        others_(team_.threads() - 1, table_),
        searches_(team_.threads(), {GapSearch(instance.graph())}) {}

  Plan run() {
    for (std::uint64_t pass = 0; pass < effort_.passes; ++pass) {
      gained_ = 0;
      const std::vector<std::uint32_t> delayed =
          mostDelayedFirst(instance_, plan_.paths, effort_.departures);
      queue_.assign(delayed.begin(), delayed.end());
      while (!queue_.empty()) {
        if (spent_ || deadline_.expired()) return std::move(plan_);
        replanBatch();
      }
      if (gained_ == 0) break;
    }
    return std::move(plan_);
  }

 private:
  ReservationTable& tableFor(std::uint32_t member) {
    return member == 0 ? table_ : others_[member - 1];
  }

  struct Change {
    std::uint32_t robot;
    Path before;
  };

  void replanBatch() {
    const std::size_t size = std::min(batch_size_.get(), queue_.size());
    batch_.assign(queue_.begin(), queue_.begin() + static_cast<std::ptrdiff_t>(size));
    queue_.erase(queue_.begin(), queue_.begin() + static_cast<std::ptrdiff_t>(size));
    searchBatch();
    SearchWork work;
    const std::uint64_t gained_before = gained_;
    postponed_.clear();
    changes_.clear();
    for (std::size_t i = 0; i < size; ++i) {
      work += answers_[i].work;
      if (!take(batch_[i], std::move(answers_[i].path))) postponed_.push_back(batch_[i]);
    }
    tellTheOthers();
    queue_.insert(queue_.begin(), postponed_.begin(), postponed_.end());
    batch_size_.adapt(size, postponed_.size());
    if (effort_.work != nullptr) *effort_.work += work;
    spent_ = effort_.go_on && !effort_.go_on(work.expansions, gained_ - gained_before);
  }

  void searchBatch() {
    answers_.resize(batch_.size());
    team_.forEach(static_cast<std::uint32_t>(batch_.size()),
                  [&](std::uint32_t i, std::uint32_t member) {
                    const std::uint32_t robot = batch_[i];
                    const Path& path = plan_.paths[robot];
                    ReservationTable& table = tableFor(member);
                    table.remove(robot, path);
                    GapQuery query;
                    query.start = instance_.start(robot);
                    const HeldDistances distances = instance_.distances(robot);
                    query.distances = &*distances;
                    query.placed = &table;
                    query.departure = effort_.departures(robot);
                    query.latest_arrival = static_cast<std::uint32_t>(path.size() - 2);
                    answers_[i] = searches_[member].value.search(query, deadline_);
                    cutBehindArrival(answers_[i].path);
                    table.insert(robot, path);
                  });
  }

  /// A robot that is at home need not arrive there when it departs.
  static void cutBehindArrival(Path& path) {
    while (path.size() > 1 && path[path.size() - 2] == path.back()) path.pop_back();
  }

  /// @return whether the robot's turn is over: it has the path, or there is none.
  bool take(std::uint32_t robot, Path path) {
    if (path.empty()) return true;
    const Path& own = plan_.paths[robot];
    if (!table_.exchange(robot, plan_.paths[robot], path)) return false;
    if (effort_.avoids_rings && closesRing(table_, own)) {
      table_.exchange(robot, plan_.paths[robot], path);
      return true;
    }
    gained_ += path.size() - own.size();  // they have changed places
    changes_.push_back({robot, std::move(path)});
    return true;
  }

  void tellTheOthers() {
    team_.forEach(static_cast<std::uint32_t>(others_.size()),
                  [&](std::uint32_t other, std::uint32_t) {
                    ReservationTable& table = others_[other];
                    for (const Change& change : changes_) table.remove(change.robot, change.before);
                    for (const Change& change : changes_) {
                      table.insert(change.robot, plan_.paths[change.robot]);
                    }
                  });
  }

  const Instance& instance_;
  Plan plan_;
  const ReplanEffort& effort_;
  const Deadline& deadline_;
  ThreadTeam team_;
  ReservationTable own_;                    // empty if one is given
  ReservationTable& table_;                 // of everybody
  std::vector<ReservationTable> others_;    // likewise, one for each thread but the first
  std::vector<Apart<GapSearch>> searches_;  // one a thread
  BatchSize batch_size_;
  std::deque<std::uint32_t> queue_;  // next first
  std::vector<std::uint32_t> batch_;
  std::vector<GapAnswer> answers_;
  std::vector<std::uint32_t> postponed_;
  std::vector<Change> changes_;  // of the batch
  std::uint64_t gained_ = 0;     // steps, in this pass
  bool spent_ = false;
};

}  // namespace

Plan replanSingly(const Instance& instance, Plan plan, const ReplanEffort& effort,
                  const Deadline& deadline) {
  trimToArrival(plan);
  if (effort.passes == 0 || mostDelayedFirst(instance, plan.paths, effort.departures).empty())
    return plan;
  return BatchReplanning(instance, std::move(plan), effort, deadline).run();
}

}  // namespace split_mapf
