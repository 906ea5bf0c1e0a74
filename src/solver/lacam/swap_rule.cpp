#include "solver/lacam/swap_rule.h"

namespace split_mapf {

SwapRule::Exits SwapRule::exitsOf(Vertex v, Vertex behind) const {
  Exits exits;
  for (const Vertex u : graph_.neighbours(v)) {
    if (u == behind) continue;
    // A robot at home in a dead end has no reason to make room there.
    const std::uint32_t robot = robot_at_[u];
    if (robot != kNoRobot && goals_[robot] == u && graph_.neighbours(u).size() == 1) continue;
    ++exits.count;
    exits.one = u;
  }
  return exits;
}

bool SwapRule::mustSwap(std::uint32_t pusher, std::uint32_t pushed, Vertex pusher_at,
                        Vertex pushed_at) const {
  // Both go down the pusher's way until there is a place where they could pass.
  while (distances_(pusher, pushed_at) < distances_(pusher, pusher_at)) {
    const Exits exits = exitsOf(pushed_at, pusher_at);
    if (exits.count >= 2) return false;
    if (exits.count == 0) break;
    pusher_at = pushed_at;
    pushed_at = exits.one;
  }
  const std::uint32_t left = distances_(pusher, pusher_at);
  return distances_(pushed, pusher_at) < distances_(pushed, pushed_at) &&
         (left == 0 || distances_(pusher, pushed_at) < left);
}

bool SwapRule::canBackOff(Vertex follower_at, Vertex leader_at) const {
  const Vertex origin = follower_at;
  while (leader_at != origin) {
    const Exits exits = exitsOf(leader_at, follower_at);
    if (exits.count != 1) return exits.count > 1;
    follower_at = leader_at;
    leader_at = exits.one;
  }
  return false;  // all round a ring
}

std::uint32_t SwapRule::partnerOf(std::uint32_t robot, Vertex wanted, const Configuration& from,
                                  const Configuration& next) const {
  const Vertex at = from[robot];
  const std::uint32_t ahead = robot_at_[wanted];
  if (ahead != kNoRobot && ahead != robot && next[ahead] == kNoVertex &&
      mustSwap(robot, ahead, at, wanted) && canBackOff(wanted, at)) {
    return ahead;
  }
  if (wanted == at) return kNoRobot;
  // Somebody behind may be about to push this robot on where it could not get out of the way.
  for (const Vertex u : graph_.neighbours(at)) {
    const std::uint32_t behind = robot_at_[u];
    if (behind == kNoRobot || u == wanted) continue;
    if (mustSwap(behind, robot, at, wanted) && canBackOff(wanted, at)) return behind;
  }
  return kNoRobot;
}

}  // namespace split_mapf
