#include "improve/incumbent.h"

#include <utility>

#include "split_mapf/core/collision.h"

namespace split_mapf {

Incumbent::Incumbent(Plan plan) : plan_(std::move(plan)) {}

std::uint64_t Incumbent::changesSince(std::uint64_t version,
                                      std::vector<PathChange>& changes) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (std::size_t i = version - first_; i < log_.size(); ++i) {
    changes.insert(changes.end(), log_[i].begin(), log_[i].end());
  }
  return first_ + log_.size();
}

bool Incumbent::conflictsWithLater(std::uint64_t seen,
                                   const std::vector<PathChange>& changes) const {
  for (std::size_t i = seen - first_; i < log_.size(); ++i) {
    for (const PathChange& later : log_[i]) {
      for (const PathChange& change : changes) {
        if (later.robot == change.robot || firstConflict(plan_.paths[later.robot], change.path)) {
          return true;
        }
      }
    }
  }
  return false;
}

bool Incumbent::offer(std::uint64_t seen, const std::vector<PathChange>& changes) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (conflictsWithLater(seen, changes)) return false;
  for (const PathChange& change : changes) plan_.paths[change.robot] = change.path;
  log_.push_back(changes);
  version_.store(first_ + log_.size(), std::memory_order_release);
  return true;
}

void Incumbent::forgetBefore(std::uint64_t version) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (; first_ < version; ++first_) log_.pop_front();
}

Plan Incumbent::plan() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return plan_;
}

}  // namespace split_mapf
