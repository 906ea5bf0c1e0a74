#include "core/all_distances.h"

#include <algorithm>
#include <limits>

namespace split_mapf {
namespace {

// A table that is found on demand takes so much for a step of its robot's shortest way.
constexpr std::uint64_t kBytesAStep = 250;
// More, and the system would end the process.
constexpr std::uint64_t kMostMebibytes = 8192;

}  // namespace

AllDistances::AllDistances(const Instance& instance, std::uint64_t steps) {
  if (!instance.isBounded()) return;  // they are few
  const std::uint64_t whole = std::uint64_t{2} * instance.robots() * instance.grid().size();
  mebibytes_ = std::min(kBytesAStep * steps, whole) >> 20U;
}

AllDistances AllDistances::everywhere(const Instance& instance) {
  return {instance, std::numeric_limits<std::uint64_t>::max() / kBytesAStep};
}

AllDistances AllDistances::atLeast(const Instance& instance) {
  const Grid& grid = instance.grid();
  if (!grid.hasUnitMoves()) return {};
  std::uint64_t steps = 0;
  for (std::uint32_t robot = 0; robot < instance.robots(); ++robot) {
    const Cell start = grid.cellOf(instance.start(robot));
    const Cell goal = grid.cellOf(instance.goal(robot));
    steps += rowsAndColumns(start, goal);
  }
  return {instance, steps};
}

bool AllDistances::areTooLarge() const { return mebibytes_ > kMostMebibytes; }

std::string AllDistances::describe(const std::string& who) const {
  return "the distances of all robots, which " + who + " keeps, would take " +
         std::to_string(mebibytes_) + " MiB, at most " + std::to_string(kMostMebibytes) +
         " MiB are possible";
}

}  // namespace split_mapf
