#include "solver/joint/joint_moves.h"

#include <algorithm>

namespace split_mapf {

bool JointMoves::prepare() {
  for (std::size_t robot = options_.size(); robot-- > 0;) {
    std::vector<MoveOption>& options = options_[robot];
    if (options.empty()) return false;
    std::stable_sort(options.begin(), options.end(), [](const MoveOption& a, const MoveOption& b) {
      return a.surplus < b.surplus;
    });
    const Rest& after = rest_[robot + 1];
    Rest& rest = rest_[robot];
    rest.least = after.least + options.front().surplus;
    rest.most = after.most + options.back().surplus;
    rest.late = after.late || std::any_of(options.begin(), options.end(),
                                          [](const MoveOption& option) { return option.late; });
  }
  return true;
}

}  // namespace split_mapf
