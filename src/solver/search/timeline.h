#pragma once

#include <cstdint>
#include <vector>

#include "solver/search/constraints.h"
#include "solver/search/path_table.h"

namespace split_mapf {

/// What the other robots' paths mean to a search.
enum class OthersAre {
  kIgnored,    ///< they are not there
  kCounted,    ///< running into them is allowed and counted
  kObstacles,  ///< running into them is forbidden
};

/// A maximal run of steps [begin, end) during which a vertex may be occupied and the others there
/// do not change.
struct Segment {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;
  std::uint16_t present = 0;   ///< others there during the segment
  std::uint16_t entering = 0;  ///< of these, the ones that come with its first step
};

/// Cuts the time at `v` into segments, in order; forbidden steps are left out. Used by the search
/// the first time it meets a vertex. Cost: O(visits at v + bans).
class TimelineBuilder {
 public:
  /// Appends the segments of `v` to `out`. `constraints` may be null when none concerns `v`.
  void build(Vertex v, std::uint32_t robot, const PathTable* others, OthersAre mode,
             const RobotConstraints* constraints, std::vector<Segment>& out);

 private:
  void appendFree(std::vector<Segment>& out);
  void appendCounted(std::vector<Segment>& out);
  static void cutBans(Vertex v, const RobotConstraints& constraints, std::size_t first,
                      std::vector<Segment>& out);

  struct Interval {
    std::uint32_t begin;
    std::uint32_t end;
  };
  std::vector<Interval> intervals_;
  std::vector<std::uint32_t> cuts_;
};

}  // namespace split_mapf
