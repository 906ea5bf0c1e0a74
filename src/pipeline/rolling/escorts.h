#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "pipeline/rolling/escort.h"
#include "pipeline/rolling/progress.h"

namespace split_mapf::rolling {

/// A robot that wants an escort.
struct StuckRobot {
  std::uint32_t index = 0;  ///< in the fleet
  std::uint32_t steps = 0;  ///< for which it has gained nothing
  const Slope* slope = nullptr;
  std::uint32_t best = 0;
  bool is_urgent = false;
};

/// The escorts under way. Their regions do not touch each other.
class Escorts {
 public:
  /// So many steps are over: escorts go on as far as the fleet has kept to them, and end where the
  /// leader has come to its target, a member is elsewhere, or a wall or somebody else is in the
  /// region.
  void goOn(const RollingQuestion& fleet, std::uint32_t steps, const std::vector<bool>& closed);
  /// Finds escorts for those that are stuck, who is longest after its goal first. A robot for which
  /// there is none is looked at again `patience` steps later. Cost: a few searches at most.
  void add(const MoveGraph& graph, const RollingQuestion& fleet, const std::vector<bool>& closed,
           std::vector<StuckRobot> stuck, std::uint64_t now, std::uint32_t patience);

  /// Whether no escort was found for a robot that has gained nothing since.
  /// @param stuck  steps for which it has gained nothing
  bool hasNone(std::uint32_t id, std::uint32_t stuck, std::uint64_t now) const;
  std::uint32_t size() const { return static_cast<std::uint32_t>(escorts_.size()); }
  const std::vector<Escort>& all() const { return escorts_; }
  /// Marks the regions.
  void bar(std::vector<bool>& barred) const;

 private:
  std::vector<Escort> escorts_;
  std::unordered_map<std::uint32_t, std::uint64_t> failed_;  // last, at step, by id
};

}  // namespace split_mapf::rolling
