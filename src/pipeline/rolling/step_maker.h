#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pipeline/rolling/move_graph.h"
#include "pipeline/rolling/step_wish.h"
#include "pipeline/rolling/swap_rule.h"
#include "pipeline/rolling/window_table.h"
#include "split_mapf/core/random.h"

namespace split_mapf::rolling {

/// Makes one step of all robots: priority inheritance with backtracking. Robots choose in order;
/// who wants the place of another lends it its priority, so that it moves away first; two that have
/// to change places do so where there is room (SwapRule). Always ends with a step for all where
/// nobody is bound.
/// Source: Okumura et al., Artificial Intelligence 310 (2022). Without recursion. Not thread-safe.
class StepMaker {
 public:
  StepMaker(const MoveGraph& graph, std::uint64_t seed);

  /// @param order  all robots, the most important first
  /// @param moves  gets the slot of each robot
  /// @return false when what is bound leaves somebody no place; `moves` is of no use then.
  /// Cost: O(robots), and the lengths of the lanes around them.
  bool make(const std::vector<StepWish>& wishes, const std::vector<std::uint32_t>& order,
            const WindowTable& table, std::vector<Slot>& moves);

 private:
  struct Frame {
    std::uint32_t robot;
    std::uint32_t partner;  // that follows if the first choice can be had
    std::uint8_t tried;
    std::uint8_t count;
    std::array<Slot, kSlots + 1> choices;
  };
  enum class Step { kSettled, kStuck, kAsks };

  bool bind(const std::vector<StepWish>& wishes);
  bool move(std::uint32_t robot, const std::vector<StepWish>& wishes, const WindowTable& table);
  void open(std::uint32_t robot, const std::vector<StepWish>& wishes, const WindowTable& table);
  void sortChoices(Frame& frame, const StepWish& wish, const WindowTable& table);
  Step advance(const std::vector<StepWish>& wishes);
  void follow(const Frame& frame, const std::vector<StepWish>& wishes);
  Vertex endOf(const StepWish& wish, Slot slot) const {
    return slot == kWait ? wish.at : graph_[wish.at].next[slot];
  }

  const MoveGraph& graph_;
  RandomEngine engine_;
  std::vector<std::uint32_t> robot_at_;    // by vertex, now
  std::vector<std::uint32_t> robot_next_;  // by vertex, behind the step
  std::vector<Slot> moves_;                // kNoSlot: not settled
  std::vector<Frame> frames_;
  SwapRule swap_rule_;
};

}  // namespace split_mapf::rolling
