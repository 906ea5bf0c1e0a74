#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/incumbent.h"
#include "pipeline/neighbourhood.h"
#include "solver/search/eviction_search.h"
#include "split_mapf/core/deadline.h"

namespace split_mapf {

/// One thread's part of a large-neighbourhood search for sum of costs: takes some robots out of its
/// copy of the plan, plans them anew one after another in a random order within what they cost
/// before, and offers the result. Nobody arrives after `latest_arrival`. Used by one thread at a
/// time.
class RefineWorker {
 public:
  RefineWorker(const Instance& instance, Incumbent& incumbent, std::uint32_t latest_arrival,
               std::uint64_t seed);
  /// Searches until the deadline; ends with the newest version.
  void run(const Deadline& deadline);
  /// Of the incumbent that its copy of the plan is.
  std::uint64_t version() const { return version_; }

 private:
  void follow();
  void replace(std::uint32_t robot, Path path);
  void tryNeighbourhood(const Deadline& deadline);
  bool replan(std::uint64_t budget, const Deadline& deadline);

  const Instance& instance_;
  Incumbent& incumbent_;
  std::uint32_t latest_arrival_;
  NeighbourhoodPicker picker_;
  EvictionSearch search_;
  Plan plan_;
  PathTable table_;
  std::uint64_t version_ = 0;
  std::vector<std::uint32_t> robots_;  // of the current neighbourhood, as are these:
  std::vector<PathChange> fresh_;
  std::uint64_t expansions_ = 0;
};

}  // namespace split_mapf
