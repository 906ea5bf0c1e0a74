#pragma once

#include <cstdint>
#include <vector>

#include "search/constraints.h"
#include "search/stay.h"

namespace split_mapf {

/// A maximal run of steps [begin, end) during which a vertex may be occupied and the others there
/// do not change.
struct Segment {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::uint16_t present = 0;   ///< others there during the segment
  std::uint16_t entering = 0;  ///< of these, the ones that come with its first step
};

/// The steps at one vertex as segments, in order.
using Timeline = std::vector<Segment>;

/// Cuts the time at a vertex into segments. Keeps its memory; not thread-safe.
class TimelineBuilder {
 public:
  /// Replaces `out` by the timeline that the visits `stays` make, the robot's own left out. It
  /// covers every step. @pre `stays` is ordered by begin. Cost: O(n log n) for n visits.
  void build(const std::vector<Stay>& stays, std::uint32_t robot, Timeline& out);

 private:
  struct Interval {
    std::uint32_t begin;
    std::uint32_t end;
  };
  std::vector<Interval> intervals_;
  std::vector<std::uint32_t> cuts_;
};

/// Takes the steps out of a timeline of `v` that the constraints forbid there.
void cutBans(Vertex v, const RobotConstraints& constraints, Timeline& timeline);

}  // namespace split_mapf
