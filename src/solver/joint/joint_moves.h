#pragma once

#include <cstdint>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/graph.h"

namespace split_mapf {

/// What one robot may do in a step.
struct MoveOption {
  std::uint32_t part = 0;        ///< its part of the next joint state
  Vertex to = kNoVertex;         ///< where it is then
  std::uint32_t left = 0;        ///< steps to the goal then, at the least
  std::uint32_t surplus = 0;     ///< how much the move is worse than the best: 0 to 2, by and large
  std::uint32_t collisions = 0;  ///< with robots outside of the group
  std::uint64_t hash = 0;        ///< of the part
  bool late = false;             ///< just keeps the bound under work
};

/// Which joint moves to make: those whose surpluses add up to a number from `least` to `most`.
struct MoveWindow {
  std::uint32_t least = 0;
  std::uint32_t most = 0;
  bool late = false;  ///< only moves in which somebody is late
};

/// The joint moves of a group in one state: every combination of the robots' options in which no
/// two robots are in one cell and none swap. Not thread-safe.
class JointMoves {
 public:
  /// @param looks  combinations that may be looked at; 0: any number. @pre the deadline outlives
  /// this object.
  JointMoves(std::uint32_t robots, std::uint64_t looks, const Deadline& deadline)
      : deadline_(deadline),
        most_looks_(looks),
        from_(robots),
        options_(robots),
        rest_(robots + 1),
        chosen_(robots) {}

  /// Forgets a robot's options. @param from  where it is.
  void begin(std::uint32_t robot, Vertex from) {
    from_[robot] = from;
    options_[robot].clear();
  }
  void add(std::uint32_t robot, const MoveOption& option) { options_[robot].push_back(option); }
  /// To be called when all options are there. False if a robot has none.
  bool prepare();
  std::uint32_t leastSurplus() const { return rest_.front().least; }
  std::uint32_t mostSurplus() const { return rest_.front().most; }

  /// Calls visit(*this) for each joint move of the window until it returns false, the looks are
  /// used up or the deadline expires. Returns false then.
  template <typename Visit>
  bool forEach(const MoveWindow& window, Visit visit) {
    window_ = window;
    return choose(0, {}, visit);
  }

  /// Of the joint move under visit.
  const MoveOption& chosen(std::uint32_t robot) const { return *chosen_[robot]; }
  std::uint64_t hash() const { return sum_.hash; }
  std::uint32_t surplus() const { return sum_.surplus; }
  std::uint32_t collisions() const { return sum_.collisions; }
  /// Combinations looked at since the object was made, complete or not.
  std::uint64_t looks() const { return looks_; }
  /// Whether as many are used up as there may be.
  bool spent() const { return most_looks_ > 0 && looks_ >= most_looks_; }

 private:
  static constexpr std::uint64_t kLooksAPoll = 1U << 14;

  /// What the options of robots i, i+1, ... allow.
  struct Rest {
    std::uint32_t least = 0;
    std::uint32_t most = 0;
    bool late = false;
  };
  struct Sum {
    std::uint32_t surplus = 0;
    std::uint32_t collisions = 0;
    std::uint64_t hash = 0;
    bool late = false;
  };

  bool conflicts(std::uint32_t robot, const MoveOption& option) const {
    for (std::uint32_t other = 0; other < robot; ++other) {
      const Vertex to = chosen_[other]->to;
      if (to == option.to || (to == from_[robot] && option.to == from_[other])) return true;
    }
    return false;
  }

  template <typename Visit>
  bool choose(std::uint32_t robot, const Sum& sum, Visit& visit) {
    if (robot == options_.size()) {
      sum_ = sum;
      return visit(*this);
    }
    const Rest& rest = rest_[robot + 1];
    for (const MoveOption& option : options_[robot]) {
      if (spent() || (++looks_ % kLooksAPoll == 0 && deadline_.expired())) return false;
      const std::uint32_t surplus = sum.surplus + option.surplus;
      if (surplus + rest.least > window_.most) break;  // they are in order
      if (surplus + rest.most < window_.least) continue;
      const bool late = sum.late || option.late;
      if (window_.late && !late && !rest.late) continue;
      if (conflicts(robot, option)) continue;
      chosen_[robot] = &option;
      if (!choose(robot + 1,
                  {surplus, sum.collisions + option.collisions, sum.hash ^ option.hash, late},
                  visit)) {
        return false;
      }
    }
    return true;
  }

  const Deadline& deadline_;
  const std::uint64_t most_looks_;
  std::vector<Vertex> from_;
  std::vector<std::vector<MoveOption>> options_;  // by robot
  std::vector<Rest> rest_;
  std::vector<const MoveOption*> chosen_;
  MoveWindow window_;
  Sum sum_;
  std::uint64_t looks_ = 0;
};

}  // namespace split_mapf
