#pragma once

#include <cstdint>
#include <queue>
#include <vector>

#include "search/explored.h"
#include "search/path_table.h"
#include "solver/joint/joint_moves.h"
#include "solver/joint/settings.h"
#include "split_mapf/core/deadline.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"

namespace split_mapf {

/// What one search over joint states has to plan.
struct JointTask {
  std::vector<std::uint32_t> robots;
  /// For makespan: plans that end by this step are all as good. A lower bound of others, say.
  std::uint64_t floor = 0;
  std::uint64_t cost_limit = JointSettings::kNoLimit;  ///< of these robots: it must be less
  /// Robots outside of the group; null: there are none. None of the group's may be in it.
  const PathTable* others = nullptr;
  /// By robot: whether one in `others` gives no way. Of the rest ties take the fewest collisions.
  std::vector<char> firm;
  std::uint32_t firm_until = 0;  ///< step from which none of the firm ones moves any more
};

/// A* over the joint states of a group of robots. A state is where all of them are; for sum of
/// costs also who has ended: is at its goal, never to move again. There a step costs 1 a robot that
/// has not, so waits at the goal are paid by who leaves it again. A robot ends when it comes to its
/// goal or not at all (waiting there before is no better), so one that is there and has not ended
/// has two steps to go at the least. Where firm robots move, or there is a latest arrival, the step
/// is part of the state, too.
/// A state's moves come in portions, the best first, and each time it waits again for its next.
/// Deterministic but for the deadline. Not thread-safe.
class JointSearch {
 public:
  enum class Outcome {
    kFound,
    kNone,         ///< proved: no plan within the limits
    kFull,         ///< as many states are met as there may be
    kSpent,        ///< the expansions are used up
    kInterrupted,  ///< by the deadline
  };

  /// @param settings  its `expansion_limit` and `states` are for this search. @pre no robot is cut
  /// off; instance, deadline and task.others outlive this object.
  JointSearch(const Instance& instance, JointTask task, const JointSettings& settings,
              const Deadline& deadline);

  Outcome run();

  /// Paths in the order of the task's robots, which end at their arrivals. @pre it was found.
  std::vector<Path> paths() const;
  /// Every plan of these robots costs at least this, or the task's cost limit [steps].
  std::uint64_t lowerBound() const { return bound_; }
  std::uint64_t expansions() const { return moves_.looks(); }
  std::uint32_t states() const { return explored_.size(); }

 private:
  static constexpr std::uint32_t kNoParent = 0xffffffffU;
  static constexpr std::uint32_t kClosed = 0xffffffffU;
  static constexpr std::uint32_t kBlocked = 0xffffffffU;

  struct Node {
    std::uint32_t parent = kNoParent;
    std::uint32_t cost = 0;        ///< so far [steps]
    std::uint32_t depth = 0;       ///< steps so far
    std::uint32_t bound = 0;       ///< of plans through the moves to come
    std::uint32_t progress = 0;    ///< least sum of surpluses of the moves to come
    std::uint32_t collisions = 0;  ///< so far, with robots that may give way
  };
  /// An entry counts only while its node is at the same bound and progress.
  struct Entry {
    std::uint32_t bound;
    std::uint32_t progress;
    std::uint64_t tie;  ///< collisions, then the distances that are left
    std::uint32_t node;
  };
  struct Later {
    bool operator()(const Entry& a, const Entry& b) const {
      if (a.bound != b.bound) return a.bound > b.bound;
      if (a.tie != b.tie) return a.tie > b.tie;
      return a.node < b.node;  // the newest first
    }
  };

  bool sums() const { return ruleOf(settings_.objective).sums(); }
  std::uint32_t robots() const { return static_cast<std::uint32_t>(task_.robots.size()); }
  Vertex vertexOf(std::uint32_t i, std::uint32_t part) const {
    return part == ended_ ? goals_[i] : part;
  }
  std::uint32_t stepsLeft(std::uint32_t i, std::uint32_t part) const;
  /// The step as part of a state.
  std::uint32_t stepPart(std::uint32_t depth) const;
  /// False where a firm robot never leaves a goal.
  bool findFreeGoals();
  void pushStarts(std::uint32_t i);
  Outcome search();
  /// Reads the state into row_; whether everybody has arrived.
  bool load(const Node& node, std::uint32_t number);
  Outcome expand(std::uint32_t number);
  void offerMoves(std::uint32_t i, const Node& node);
  void offer(std::uint32_t i, const Node& node, std::uint32_t part);
  /// kBlocked where a firm robot is in the way.
  std::uint32_t collisionsOf(Vertex from, Vertex to, std::uint32_t step) const;
  MoveWindow windowOf(const Node& node) const;
  bool pushChild(std::uint32_t parent, std::uint64_t base);
  /// False when there is no room for it.
  bool push(const Node& node, std::uint64_t left, std::uint64_t hash);
  void open(std::uint32_t number, std::uint64_t left);
  /// Has the node wait for its next portion of moves, if it has one.
  void postpone(std::uint32_t number, const MoveWindow& done);
  /// The same for a portion with a higher bound. @param more  whether there is one.
  void raiseBound(std::uint32_t number, bool more, std::uint32_t bound, std::uint32_t progress);

  const Instance& instance_;
  const JointTask task_;
  const JointSettings settings_;
  const Deadline& deadline_;
  const std::uint32_t ended_;  // the part of a robot that has ended
  bool timed_ = false;         // whether the step is part of the state
  std::uint64_t limit_ = 0;    // of costs: they must be less
  std::uint32_t floor_ = 0;
  std::vector<HeldDistances> distances_;  // by place in the task, as are all of these
  std::vector<Vertex> goals_;
  std::vector<std::uint32_t> free_from_;  // step from which no firm robot is at the goal
  Explored explored_;
  std::vector<Node> nodes_;
  std::priority_queue<Entry, std::vector<Entry>, Later> open_;
  JointMoves moves_;
  Configuration row_;            // the state under work
  Configuration next_;           // one that it leads to
  std::uint32_t active_ = 0;     // robots in row_ that have not ended
  std::uint32_t most_left_ = 0;  // steps left of one in row_
  std::uint64_t left_ = 0;       // of all
  bool more_ = false;            // whether there are moves beyond the bound under work
  std::uint64_t bound_ = 0;
  std::uint32_t goal_ = kNoParent;
  bool full_ = false;
};

}  // namespace split_mapf
