#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "pipeline/rolling/itinerary.h"
#include "pipeline/rolling/window_table.h"
#include "split_mapf/core/random.h"

namespace split_mapf::rolling {

/// Finds the cheapest track of one robot among the others to the end of the window: best-first over
/// vertex, step and goals reached. What a state costs does not depend on the way to it (but for
/// moves of idle robots, where the first way counts), so each is met once; of equally cheap ways
/// one goes straight on where it can. Moves that cost more wait until it is their turn. Keeps its
/// memory between searches. Not thread-safe.
class WindowSearch {
 public:
  WindowSearch(const MoveGraph& graph, std::uint32_t window);

  /// Fills the track behind `itinerary.free_from`; what is before stays.
  /// @param most  the greatest cost behind free_from that is of use.
  /// @pre `table` does not hold the track behind free_from.
  /// @return the cost behind free_from; nothing when every track costs more.
  std::optional<std::uint32_t> find(const WindowTable& table, const Itinerary& itinerary,
                                    std::uint32_t most, RandomEngine& engine, Track& track);
  /// States looked at so far.
  std::uint64_t expansions() const { return expansions_; }

 private:
  struct State {
    Vertex vertex;
    std::uint32_t parent;
    std::uint32_t next;  // in its bucket
    std::uint8_t step;
    std::uint8_t reached;
    Slot came_by;        // slot that leads back to the vertex before
    std::uint8_t stage;  // moves that cost less than so many of the three kinds are done
  };
  struct Met {
    std::uint32_t search = 0;
    std::uint32_t steps = 0;  // a bit each
  };
  static constexpr std::uint32_t kNone = 0xffffffffU;
  static constexpr std::uint32_t kKeys = 2 * kMostStepCost * kMostSteps + 1;

  void begin(const Itinerary& itinerary, const Track& track);
  std::uint32_t pop();
  void push(std::uint32_t key, const State& state);
  bool meet(Vertex v, std::uint32_t step, std::uint32_t reached);
  void expand(std::uint32_t index, const WindowTable& table, const Itinerary& itinerary);
  void tryWait(std::uint32_t index, const WindowTable& table);
  void tryMoves(std::uint32_t index, std::uint32_t slots, const WindowTable& table,
                const Itinerary& itinerary);
  void tryMove(std::uint32_t index, Slot slot, const WindowTable& table,
               const Itinerary& itinerary);
  void defer(std::uint32_t index, std::uint32_t cost);
  void write(std::uint32_t index, Track& track) const;

  const MoveGraph& graph_;
  std::uint32_t window_;
  std::vector<Met> met_;  // by goals reached, then vertex
  std::vector<State> states_;
  std::array<std::uint32_t, kKeys> buckets_;
  std::uint32_t current_ = 0;
  std::uint32_t last_ = 0;  // the greatest key that may be in use
  std::uint32_t most_ = 0;
  std::uint32_t search_ = 0;
  std::uint64_t random_ = 0;
  std::uint64_t expansions_ = 0;
};

}  // namespace split_mapf::rolling
