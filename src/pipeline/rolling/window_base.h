#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/rolling/fleet_window.h"
#include "pipeline/rolling/step_maker.h"
#include "split_mapf/core/plan.h"

namespace split_mapf::rolling {

/// What a robot is bound to do, and what it was going to do behind that.
struct WindowStart {
  const Path* prefix = nullptr;  ///< never empty; what is behind the window's end does not matter
  const Path* known = nullptr;   ///< from step 0 on; may be empty or wrong
};

/// Makes the first valid window: what was known of each robot as far as it still
/// holds, the rest step by step by priority inheritance. Not thread-safe.
class WindowBase {
 public:
  WindowBase(const MoveGraph& graph, const std::vector<bool>& closed, std::uint64_t seed)
      : graph_(graph), table_(graph, closed), maker_(graph, seed) {}

  void close(const std::vector<bool>& closed) { table_.close(closed); }
  /// Fills the tracks. @pre the itineraries are those of the robots; all may stop at the ends of
  /// their prefixes. @param order  the most important robot first
  void make(const std::vector<WindowStart>& starts, const std::vector<std::uint32_t>& order,
            FleetWindow& window);
  /// Makes another window of no more than what robots are bound to, and takes it if it costs less:
  /// what was known may be a jam that grew with every step kept, and that no neighbourhood is wide
  /// enough to undo. @pre make() has made the window.
  void renew(const std::vector<std::uint32_t>& order, FleetWindow& window);

 private:
  bool makeSteps(const std::vector<WindowStart>& starts, const std::vector<std::uint32_t>& order,
                 FleetWindow& window);
  /// Keeps what is known of all robots if nothing of it is in the way of anything, robot by robot:
  /// what happens in nearly every step. @return the steps that are made, 0 if it does not hold.
  std::uint32_t keepKnownAtOnce(const std::vector<WindowStart>& starts, FleetWindow& window);
  bool keepWay(const WindowStart& start, std::uint32_t robot, std::uint32_t last,
               FleetWindow& window);
  bool isTaken(Vertex at, Slot slot, std::uint32_t t) const;
  bool keepKnown(std::uint32_t t, FleetWindow& window);
  void wish(const std::vector<WindowStart>& starts, std::uint32_t robot, std::uint32_t t,
            const FleetWindow& window);
  Slot straightOn(const Track& track, std::uint32_t t) const;
  void advance(std::uint32_t robot, std::uint32_t t, Slot slot, FleetWindow& window);

  const MoveGraph& graph_;
  WindowTable table_;
  StepMaker maker_;
  std::uint32_t stop_until_ = 0;  // everybody waits behind its prefix until this step
  std::vector<StepWish> wishes_;  // by robot, for the step at hand
  std::vector<Slot> moves_;
  std::vector<std::uint32_t> reached_;  // by robot: goals, at the step at hand
  std::vector<bool> on_known_;          // by robot: still where it was known to be
  FleetWindow other_;                   // that renew() makes
};

}  // namespace split_mapf::rolling
