#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "search/explored.h"
#include "solver/lacam/guidance.h"
#include "solver/lacam/robot_distances.h"
#include "solver/lacam/step_prices.h"
#include "solver/lacam/swap_rule.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/random.h"

namespace split_mapf {

/// Priority inheritance with backtracking: makes one configuration from another. Robots choose in
/// order of priority; one that wants a place where another stands lends it its priority, so that it
/// moves away first; a chain that comes back to where it began is a rotation, which needs no empty
/// cell. First choice is the robot's guidance, then what is nearer to its goal, ties at random.
/// Source: Okumura et al., Artificial Intelligence 310 (2022). Without recursion. Not thread-safe.
class Pibt {
 public:
  /// @param guidance  may be null.
  /// @param prices  null: robots choose by guidance and distance; else by these alone. The
  /// references outlive this object.
  Pibt(const Instance& instance, const RobotDistances& distances, const Guidance* guidance,
       bool swap, std::uint64_t seed, const StepPrices* prices = nullptr);

  /// Gives every robot whose place in `next` is kNoVertex a place. @return whether all robots got
  /// one without conflicts; `next` is of no use otherwise. @pre who has a place in `next` gets
  /// there by a move or a wait. Cost: O(robots) and the searches for a partner.
  bool complete(const Configuration& from, const std::vector<std::uint32_t>& order,
                Configuration& next);
  /// Robots moved so far.
  std::uint64_t expansions() const { return expansions_; }

 private:
  static constexpr std::uint32_t kMostChoices = 5;

  struct Frame {
    std::uint32_t robot;
    std::uint32_t partner;  // follows when the first choice is taken
    std::uint8_t tried;
    std::uint8_t count;
    std::array<Vertex, kMostChoices> choices;
  };
  enum class Step { kSettled, kStuck, kAsks };

  bool reserveFixed(const Configuration& from, const Configuration& next);
  void forget(const Configuration& from, const Configuration& next);
  bool move(std::uint32_t robot, const Configuration& from, Configuration& next);
  void open(std::uint32_t robot, const Configuration& from, const Configuration& next);
  void sortChoices(Frame& frame, Vertex at);
  std::uint64_t keyOf(std::uint32_t robot, Vertex v) const;
  Step advance(const Configuration& from, Configuration& next);
  void follow(const Frame& frame, const Configuration& from, Configuration& next);

  const Graph& graph_;
  const RobotDistances& distances_;
  const Guidance* guidance_;
  const StepPrices* prices_;
  bool swap_;
  RandomEngine engine_;
  std::vector<std::uint32_t> robot_at_;    // by vertex, now
  std::vector<std::uint32_t> robot_next_;  // by vertex, in the next configuration
  SwapRule swap_rule_;
  std::vector<Frame> frames_;
  std::uint64_t expansions_ = 0;
};

}  // namespace split_mapf
