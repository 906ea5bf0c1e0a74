#pragma once

#include <cstdint>

#include "search/path_table.h"
#include "search/safe_interval_search.h"
#include "solver/ecbs/settings.h"
#include "split_mapf/core/instance.h"

namespace split_mapf {

/// The single-robot searches of one run: builds their queries, counts their expansions, and knows
/// when to stop. Not thread-safe.
class LowLevel {
 public:
  /// @pre all arguments outlive this object.
  /// @param reserved  null: nothing is.
  LowLevel(const Instance& instance, const EcbsSettings& settings, const PathTable& table,
           const PathTable* reserved, const Deadline& deadline);

  /// For the path with the fewest collisions whose length keeps w times a lower bound: `bound` is
  /// that of all robots for makespan, of this one for sum of costs; `own_bound` is this robot's.
  SearchQuery fewestCollisions(std::uint32_t robot, std::uint32_t bound,
                               std::uint32_t own_bound) const;
  /// For the shortest path, the others being ignored.
  SearchQuery shortest(std::uint32_t robot) const;

  /// Empty when there is no path or the run is to stop. The distances are the robot's, whatever the
  /// query says.
  Path run(SearchQuery query);
  /// Whether the run has to end: by its deadline or its limit of expansions.
  bool stopped();
  /// Adds work done elsewhere to the expansions of this run.
  void count(std::uint64_t expansions);
  bool exhausted() const { return exhausted_; }
  /// Expansions until the limit.
  std::uint64_t left() const;
  std::uint64_t expansions() const { return expansions_; }

 private:
  const Instance& instance_;
  const EcbsSettings& settings_;
  const PathTable& table_;
  const PathTable* reserved_;
  const Deadline& deadline_;
  SafeIntervalSearch search_;
  std::uint64_t expansions_ = 0;
  bool interrupted_ = false;
  bool exhausted_ = false;
};

}  // namespace split_mapf
