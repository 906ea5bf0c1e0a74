#pragma once

#include <cstdint>

#include "improve/annealing.h"
#include "improve/incumbent.h"
#include "search/neighbourhood_search.h"
#include "split_mapf/core/deadline.h"

namespace split_mapf {

/// One thread's part of a refinement: a large-neighbourhood search on its own copy of the plan that
/// offers what it finds and follows what others found. Nobody arrives after `latest_arrival`, and
/// reserved paths (null: none) are kept clear of. Used by one thread at a time.
class RefineWorker {
 public:
  RefineWorker(const Instance& instance, Incumbent& incumbent, std::uint32_t latest_arrival,
               std::uint64_t seed, const Reservations* reserved);
  /// Searches until the deadline; ends with the newest version. @param annealing  null: the plan
  /// must not become worse.
  void run(const Deadline& deadline, const Annealing* annealing);
  /// Of the incumbent that its copy of the plan is.
  std::uint64_t version() const { return version_; }

 private:
  void follow();

  Incumbent& incumbent_;
  NeighbourhoodSearch search_;
  std::uint64_t version_ = 0;
};

}  // namespace split_mapf
