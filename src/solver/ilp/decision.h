#pragma once

#include <cstdint>
#include <vector>

#include "solver/ilp/conflict_row.h"
#include "solver/ilp/robot_rules.h"
#include "split_mapf/core/instance.h"

namespace split_mapf::ilp {

/// What a child of the tree decides for one robot.
struct Decision {
  enum class Kind {
    kNone,         ///< the root
    kAt,           ///< at `vertex` at `step`; so nobody else is
    kNotAt,        ///< not at `vertex` at `step`
    kArriveBy,     ///< arrives by `step`; so nobody else is at its goal from then on
    kArriveAfter,  ///< arrives later than `step`
  };
  Kind kind = Kind::kNone;
  std::uint32_t robot = 0;
  Vertex vertex = kNoVertex;
  std::uint32_t step = 0;
};

/// Adds a decision to the rules of all robots. @param rules  one a robot.
void apply(const Decision& decision, const Instance& instance, std::vector<RobotRules>& rules);

/// Whether a robot's path is allowed where the decision holds.
bool obeys(std::uint32_t robot, const Path& path, const Decision& decision,
           const Instance& instance);

/// Two decisions of which every plan obeys exactly one.
struct Fork {
  Decision first;  ///< the tighter one
  Decision second;
  double doubt = 0;  ///< how undecided the solution is: 0 to 0.5
};

/// What there is to branch on, the most doubtful first: for each robot at most one arrival and one
/// vertex in a step. Empty when each robot uses one path only.
/// @param used  robot by robot. @param by_arrival  whether arrivals are looked at.
/// @param most  of either kind.
std::vector<Fork> chooseForks(const std::vector<UsedPath>& used, bool by_arrival, std::size_t most);
/// Whether chooseForks() finds any.
bool isUndecided(const std::vector<UsedPath>& used, bool by_arrival);

}  // namespace split_mapf::ilp
