#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "search/explored.h"
#include "search/packed_rows.h"
#include "solver/lacam/constraint_queue.h"
#include "solver/lacam/guidance.h"
#include "solver/lacam/pibt.h"
#include "solver/lacam/robot_distances.h"
#include "solver/lacam/settings.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/parallel/lent_threads.h"

namespace split_mapf {

/// One run of LaCAM: depth first from the starts, always on from the configuration that was reached
/// last, new or not; configurations all of whose successors came up drop out.
class LacamSearch {
 public:
  enum class Outcome {
    kFound,
    kExhausted,    ///< every configuration that can be reached was: there is no plan
    kSpent,        ///< the expansion limit came first
    kFull,         ///< the memory for configurations is used up
    kInterrupted,  ///< the deadline
  };

  /// @pre nobody is cut off; the references outlive this object.
  LacamSearch(const Instance& instance, const LacamSettings& settings, const LentThreads& threads,
              const Deadline& deadline);

  Outcome run();
  /// @pre run() found one. Paths end at their arrivals.
  Plan plan() const;
  /// Configurations met.
  std::uint32_t configurations() const { return explored_.size(); }
  std::uint64_t expansions() const { return guidance_expansions_ + pibt_->expansions(); }

 private:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  struct Node {  // a configuration, in a list whose front is searched next
    std::uint32_t parent = kNone;
    std::uint32_t above = kNone;
    std::uint32_t below = kNone;
    bool exhausted = false;
    ConstraintQueue constraints;
  };

  void makeGuidance(std::uint64_t rounds);
  void addStart();
  void load(std::uint32_t node);
  bool isCrowd() const;
  bool isSpent() const;
  bool isFull();
  std::uint32_t reach();
  bool atGoals(const Configuration& configuration) const;
  void unlink(std::uint32_t node);
  void pushFront(std::uint32_t node);

  const Instance& instance_;
  const LacamSettings& settings_;
  const LentThreads threads_;
  const Deadline& deadline_;
  std::unique_ptr<RobotDistances> distances_;
  std::unique_ptr<Guidance> guidance_;
  std::uint64_t guidance_expansions_ = 0;
  std::unique_ptr<Pibt> pibt_;
  RandomEngine engine_;
  Explored explored_;
  PackedRows orders_;
  std::vector<Node> nodes_;
  std::uint32_t front_ = kNone;
  std::size_t constraint_bytes_ = 0;
  std::uint32_t goal_node_ = kNone;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> shortcuts_;  // moves to nodes known before

  std::uint32_t loaded_ = kNone;      // the node in
  Configuration from_;                // these
  std::vector<std::uint32_t> order_;  // two
  Configuration next_;                // its successor
  std::vector<std::uint32_t> next_order_;
  std::vector<std::uint32_t> ranks_;  // who goes first among those at home
};

}  // namespace split_mapf
