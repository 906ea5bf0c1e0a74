#include "core/loop_order.h"

#include <algorithm>
#include <unordered_map>

namespace split_mapf {

std::optional<std::array<std::uint32_t, 3>> findOvertaking(
    const std::vector<std::uint32_t>& starts, const std::vector<std::uint32_t>& goals) {
  if (starts.size() < 3) return std::nullopt;
  std::vector<std::uint32_t> rotated = goals;
  std::rotate(rotated.begin(), std::find(rotated.begin(), rotated.end(), starts[0]), rotated.end());
  const auto [start, goal] = std::mismatch(starts.begin(), starts.end(), rotated.begin());
  if (start == starts.end()) return std::nullopt;
  // Up to here both agree: each of the two robots comes later in the other list.
  return std::array<std::uint32_t, 3>{starts[0], *start, *goal};
}

bool isOddPermutation(const std::vector<std::uint32_t>& starts,
                      const std::vector<std::uint32_t>& goals) {
  std::unordered_map<std::uint32_t, std::size_t> goal_index;
  for (std::size_t i = 0; i < goals.size(); ++i) goal_index[goals[i]] = i;
  std::vector<bool> seen(starts.size(), false);
  bool is_odd = false;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    // A cycle of k places takes k - 1 exchanges.
    for (std::size_t j = i; !seen[j]; j = goal_index[starts[j]]) {
      seen[j] = true;
      if (goal_index[starts[j]] != i) is_odd = !is_odd;
    }
  }
  return is_odd;
}

}  // namespace split_mapf
