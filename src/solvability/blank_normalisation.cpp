#include "solvability/blank_normalisation.h"

#include <algorithm>

namespace split_mapf {
namespace {

/// Lets robots sink: afterwards no robot stands above an empty vertex. Vertices are filled in
/// postorder, each by the nearest robot not yet placed on its way up to the root; the way down to
/// it is free, since all robots in between have been placed below.
class Sinking {
 public:
  Sinking(const PartTree& tree, const std::vector<std::uint32_t>& robots, const Deadline& deadline)
      : placed_(tree.size(), kNoRobot) {
    SparsePoll poll(deadline);
    std::vector<std::uint32_t> path;
    for (std::uint32_t rank = 0; rank < tree.size(); ++rank) {
      poll();
      while (!path.empty() && path.back() != tree.parent[rank]) leave(path);
      path.push_back(rank);
      if (robots[rank] != kNoRobot) waiting_.push_back(robots[rank]);
    }
    while (!path.empty()) leave(path);
  }
  std::vector<std::uint32_t> takeResult() { return std::move(placed_); }

 private:
  void leave(std::vector<std::uint32_t>& path) {
    if (!waiting_.empty()) {
      placed_[path.back()] = waiting_.back();
      waiting_.pop_back();
    }
    path.pop_back();
  }

  std::vector<std::uint32_t> placed_;
  std::vector<std::uint32_t> waiting_;  // robots on the current way from the root, lowest last
};

}  // namespace

std::vector<std::uint32_t> gatherBlanks(const PartTree& tree,
                                        const std::vector<std::uint32_t>& robots,
                                        const Deadline& deadline) {
  const auto blanks =
      static_cast<std::uint32_t>(std::count(robots.begin(), robots.end(), kNoRobot));
  std::vector<std::uint32_t> result = Sinking(tree, robots, deadline).takeResult();
  // The empty vertices now include the root and the parent of each. A robot among the lowest ranks
  // leaves once those above it have left, and goes where no empty vertex lies below.
  std::uint32_t to = tree.size();
  for (std::uint32_t from = 0; from < blanks; ++from) {
    if (result[from] == kNoRobot) continue;
    do {
      --to;
    } while (result[to] != kNoRobot);
    std::swap(result[from], result[to]);
  }
  return result;
}

}  // namespace split_mapf
