#include "solver/ilp/penalties.h"

#include <algorithm>
#include <limits>

namespace split_mapf::ilp {

void Penalties::clear() {
  for (const MoveId move : touched_) of_move_[move] = 0;
  touched_.clear();
  for (auto& own : own_) own.clear();
}

void Penalties::cover(std::uint32_t robot, const RobotRules& rules) {
  for (const auto& [move, penalty] : own_[robot]) overlay(move, of_move_[move] + penalty);
  for (const RobotRules::Ban& ban : rules.bans) {
    const std::uint32_t end = std::min(ban.end, space_.horizon() + 1);
    for (std::uint32_t t = std::max(ban.begin, 1U); t < end; ++t) {
      const MoveId first = space_.into(t - 1, ban.vertex);
      for (std::uint32_t slot = 0; slot < space_.slots(); ++slot) {
        overlay(first + slot, std::numeric_limits<double>::infinity());
      }
    }
  }
}

void Penalties::uncover() {
  for (auto entry = saved_.rbegin(); entry != saved_.rend(); ++entry) {
    of_move_[entry->first] = entry->second;
  }
  saved_.clear();
}

}  // namespace split_mapf::ilp
