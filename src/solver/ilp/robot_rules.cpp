#include "solver/ilp/robot_rules.h"

#include <algorithm>

namespace split_mapf::ilp {

bool RobotRules::allow(const Path& path, std::uint32_t horizon) const {
  const auto arrival = static_cast<std::uint32_t>(path.size()) - 1;
  if (arrival < earliest_arrival || arrival > latest_arrival) return false;
  const bool posted = std::all_of(posts.begin(), posts.end(), [&](const Post& post) {
    return positionAt(path, post.step) == post.vertex;
  });
  if (!posted) return false;
  return std::none_of(bans.begin(), bans.end(), [&](const Ban& ban) {
    for (std::uint32_t t = ban.begin; t < ban.end && t <= horizon; ++t) {
      if (positionAt(path, t) == ban.vertex) return true;
    }
    return false;
  });
}

}  // namespace split_mapf::ilp
