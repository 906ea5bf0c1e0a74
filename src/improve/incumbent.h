#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <mutex>
#include <vector>

#include "search/neighbourhood_search.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// The plan that the workers of a refinement share. It is valid at every moment. Workers keep
/// copies of it and offer changes against the version that they saw; a change that conflicts with
/// what others have changed since is refused. Thread-safe.
class Incumbent {
 public:
  /// @pre the plan is valid and its paths end at their arrivals.
  explicit Incumbent(Plan plan);

  std::uint64_t version() const { return version_.load(std::memory_order_acquire); }
  /// Appends all changes since `version` to `changes`, oldest first; returns the version after
  /// them.
  std::uint64_t changesSince(std::uint64_t version, std::vector<PathChange>& changes) const;
  /// Takes over new paths that are valid against version `seen`, whatever they cost. Refuses,
  /// changing nothing, when they conflict with later changes.
  bool offer(std::uint64_t seen, const std::vector<PathChange>& changes);
  /// Frees what nobody will ask for. @pre nobody has seen less than `version`.
  void forgetBefore(std::uint64_t version);
  Plan plan() const;

 private:
  bool conflictsWithLater(std::uint64_t seen, const std::vector<PathChange>& changes) const;

  mutable std::mutex mutex_;
  Plan plan_;
  // Entry i leads from version first_ + i to the next.
  std::deque<std::vector<PathChange>> log_;
  std::uint64_t first_ = 0;
  std::atomic<std::uint64_t> version_{0};
};

}  // namespace split_mapf
