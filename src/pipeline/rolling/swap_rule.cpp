#include "pipeline/rolling/swap_rule.h"

namespace split_mapf::rolling {

SwapRule::Exits SwapRule::exitsOf(Vertex v, Vertex behind, const std::vector<StepWish>& wishes,
                                  const WindowTable& table) const {
  Exits exits;
  for (std::uint32_t open = table[v].open; open != 0; open &= open - 1) {
    const Vertex u = graph_[v].next[static_cast<std::size_t>(__builtin_ctz(open))];
    if (u == behind) continue;
    // An idle robot in a dead end cannot make room there.
    const std::uint32_t robot = robot_at_[u];
    if (robot != kNoRobot && wishes[robot].isIdle() && graph_[u].degree == 1) continue;
    ++exits.count;
    exits.one = u;
  }
  return exits;
}

bool SwapRule::mustSwap(const std::uint8_t* pusher, const std::uint8_t* pushed, Vertex pusher_at,
                        Vertex pushed_at, const std::vector<StepWish>& wishes,
                        const WindowTable& table) const {
  if (pusher == nullptr) return false;
  // Both go down the pusher's way until there is a place where they could pass.
  while (comesNearer(pusher, pusher_at, pushed_at)) {
    const Exits exits = exitsOf(pushed_at, pusher_at, wishes, table);
    if (exits.count >= 2) return false;
    if (exits.count == 0) {
      if (pushed == nullptr) return true;
      break;
    }
    pusher_at = pushed_at;
    pushed_at = exits.one;
  }
  const bool has_arrived = (pusher[pusher_at] & 0xfU) == 0;
  return comesNearer(pushed, pushed_at, pusher_at) &&
         (has_arrived || comesNearer(pusher, pusher_at, pushed_at));
}

bool SwapRule::canBackOff(Vertex follower_at, Vertex leader_at, const std::vector<StepWish>& wishes,
                          const WindowTable& table) const {
  const Vertex origin = follower_at;
  while (leader_at != origin) {
    const Exits exits = exitsOf(leader_at, follower_at, wishes, table);
    if (exits.count != 1) return exits.count > 1;
    follower_at = leader_at;
    leader_at = exits.one;
  }
  return false;  // all round a ring
}

std::uint32_t SwapRule::partnerOf(std::uint32_t robot, Slot wanted,
                                  const std::vector<StepWish>& wishes,
                                  const std::vector<Slot>& moves, const WindowTable& table) const {
  const Vertex at = wishes[robot].at;
  const MoveGraph::Node& node = graph_[at];
  // Nobody may follow into a closed vertex. Its neighbours know that it is one.
  if (node.degree == 0 || (table[node.next[0]].open >> node.back[0] & 1U) == 0) return kNoRobot;
  const Vertex to = wanted == kWait ? at : node.next[wanted];
  const std::uint32_t ahead = robot_at_[to];
  if (ahead != kNoRobot && ahead != robot && moves[ahead] == MoveGraph::kNoSlot &&
      mustSwap(wishes[robot].slope, wishes[ahead].slope, at, to, wishes, table) &&
      canBackOff(to, at, wishes, table)) {
    return ahead;
  }
  if (to == at) return kNoRobot;
  // Somebody behind may be about to push this robot on where it could not get out of the way.
  for (Slot slot = 0; slot < node.degree; ++slot) {
    const Vertex u = node.next[slot];
    const std::uint32_t behind = robot_at_[u];
    if (behind == kNoRobot || u == to) continue;
    if (mustSwap(wishes[behind].slope, wishes[robot].slope, at, to, wishes, table) &&
        canBackOff(to, at, wishes, table)) {
      return behind;
    }
  }
  return kNoRobot;
}

}  // namespace split_mapf::rolling
