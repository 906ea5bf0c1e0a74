#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "split_mapf/core/grid.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// Checks steps of robots that have no goals to hold: every entry a free cell, every move along an
/// edge or a wait, no two robots in one cell, none that swap. Shares no code with any planner.
/// Keeps 12 bytes a cell between calls. Not thread-safe.
class FleetChecker {
 public:
  explicit FleetChecker(std::shared_ptr<const Grid> grid);

  /// The first thing wrong with paths, in a sentence that names robots (by index), cells and step;
  /// nothing when all is well. A robot whose path has ended stays. Cost: O(entries).
  std::optional<std::string> violation(const std::vector<Path>& paths);
  /// The same for one step of all robots.
  std::optional<std::string> violation(const std::vector<Vertex>& from,
                                       const std::vector<Vertex>& to);

 private:
  std::optional<std::string> stand(const std::vector<Vertex>& at);
  std::optional<std::string> step(const std::vector<Vertex>& from, const std::vector<Vertex>& to);

  std::shared_ptr<const Grid> grid_;
  std::uint64_t round_ = 0;
  std::vector<std::uint64_t> seen_;   // by vertex: the round in which somebody was there last
  std::vector<std::uint32_t> robot_;  // by vertex: who
};

}  // namespace split_mapf
