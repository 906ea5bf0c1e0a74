#include "pipeline/incumbent.h"

#include <algorithm>
#include <utility>

namespace split_mapf {
namespace {

bool conflict(const Path& a, const Path& b) {
  const auto end = static_cast<std::uint32_t>(std::max(a.size(), b.size()));
  for (std::uint32_t t = 0; t < end; ++t) {
    if (positionAt(a, t) == positionAt(b, t)) return true;
    if (t > 0 && positionAt(a, t) == positionAt(b, t - 1) &&
        positionAt(a, t - 1) == positionAt(b, t)) {
      return true;
    }
  }
  return false;
}

}  // namespace

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
        if (later.robot == change.robot || conflict(plan_.paths[later.robot], change.path)) {
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
