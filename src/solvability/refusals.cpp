#include "split_mapf/solvability/refusals.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace split_mapf {
namespace {

/// Checks fewer and fewer of an instance's robots.
class ShrinkingCheck {
 public:
  ShrinkingCheck(const Instance& instance, const Deadline& deadline)
      : instance_(instance),
        deadline_(deadline),
        checker_(instance.grid().graph(deadline), deadline) {
    robots_.resize(instance.robots());
    std::iota(robots_.begin(), robots_.end(), 0U);
  }

  /// The next verdict, by the instance's robots. kNone when there is no further one.
  SolvabilityVerdict next() {
    std::vector<Vertex> starts;
    std::vector<Vertex> goals;
    for (const std::uint32_t robot : robots_) {
      starts.push_back(instance_.start(robot));
      goals.push_back(instance_.goal(robot));
    }
    SolvabilityVerdict verdict = checker_.check(starts, goals, deadline_);
    for (std::uint32_t& robot : verdict.robots) robot = robots_[robot];
    if (verdict.answer == Solvability::kUnsolvable) leaveOut(verdict);
    return verdict;
  }

 private:
  void leaveOut(SolvabilityVerdict& verdict) {
    const std::vector<bool> part = partAround(instance_.start(verdict.robots.front()));
    for (const Vertex left : left_out_) {
      if (part[left]) --verdict.blanks;
    }
    std::vector<std::uint32_t> named = verdict.robots;
    std::sort(named.begin(), named.end());
    for (const std::uint32_t robot : named) left_out_.push_back(instance_.start(robot));
    robots_.erase(std::remove_if(robots_.begin(), robots_.end(),
                                 [&](std::uint32_t robot) {
                                   return std::binary_search(named.begin(), named.end(), robot);
                                 }),
                  robots_.end());
  }

  std::vector<bool> partAround(Vertex root) const {
    std::vector<bool> seen(instance_.graph().size(), false);
    std::vector<Vertex> open = {root};
    seen[root] = true;
    while (!open.empty()) {
      const Vertex v = open.back();
      open.pop_back();
      for (const Vertex next : instance_.graph().neighbours(v)) {
        if (seen[next]) continue;
        seen[next] = true;
        open.push_back(next);
      }
    }
    return seen;
  }

  const Instance& instance_;
  const Deadline& deadline_;
  SolvabilityChecker checker_;
  std::vector<std::uint32_t> robots_;  // not yet named
  std::vector<Vertex> left_out_;       // starts of those that are
};

}  // namespace

std::vector<SolvabilityVerdict> findRefusals(const Instance& instance, const Deadline& deadline) {
  std::vector<SolvabilityVerdict> refusals;
  try {
    ShrinkingCheck check(instance, deadline);
    while (refusals.size() < kMostRefusals) {
      SolvabilityVerdict verdict = check.next();
      if (verdict.answer != Solvability::kUnsolvable) break;
      refusals.push_back(std::move(verdict));
    }
  } catch (const Interrupted&) {
    // What is found holds.
  }
  return refusals;
}

}  // namespace split_mapf
