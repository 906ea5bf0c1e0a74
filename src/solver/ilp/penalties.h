#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "solver/ilp/moves.h"
#include "solver/ilp/robot_rules.h"

namespace split_mapf::ilp {

/// What each move costs beside its time: the duals of the rows that it takes part in. Most rows
/// concern every robot; what concerns single robots is laid over the rest for one pricing at a
/// time, and so is what branching forbids.
class Penalties {
 public:
  Penalties(const MoveSpace& space, std::uint32_t robots)
      : space_(space), of_move_(space.size(), 0.0), own_(robots) {}

  void clear();
  void add(MoveId move, double penalty) {
    of_move_[move] += penalty;
    touched_.push_back(move);
  }
  void addFor(std::uint32_t robot, MoveId move, double penalty) {
    own_[robot].emplace_back(move, penalty);
  }

  /// Lays a robot's own penalties and bans over the others, until uncover().
  void cover(std::uint32_t robot, const RobotRules& rules);
  void uncover();
  /// By move. @pre covered for the robot that is meant.
  const double* data() const { return of_move_.data(); }

 private:
  void overlay(MoveId move, double value) {
    saved_.emplace_back(move, of_move_[move]);
    of_move_[move] = value;
  }

  const MoveSpace& space_;
  std::vector<double> of_move_;
  std::vector<MoveId> touched_;
  std::vector<std::vector<std::pair<MoveId, double>>> own_;
  std::vector<std::pair<MoveId, double>> saved_;
};

}  // namespace split_mapf::ilp
