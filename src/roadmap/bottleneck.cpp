#include "split_mapf/roadmap/bottleneck.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <unordered_map>

#include "split_mapf/roadmap/distance_field.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;
// A disc wider than this many cells is told apart by less than its exact need.
constexpr std::int32_t kMostLevels = 1 << 24;

/// Joins cells from the widest down, and notices when the two ends of a way come together.
class Joining {
 public:
  Joining(const ObstacleRaster& raster, std::size_t pairs)
      : raster_(raster), parents_(raster.blocked.size(), kNone), found_(pairs) {}

  /// @param end  number of a pair, doubled, plus 1 for its second place
  void addEnd(std::uint32_t cell, std::uint32_t end) { ends_[cell].push_back(end); }

  void open(std::uint32_t cell, double distance_m) {
    if (parents_[cell] != kNone) return;
    parents_[cell] = cell;
    const Cell c = raster_.cellAt(cell);
    const Bottleneck here{distance_m,
                          {(c.x + 0.5) * raster_.resolution_m, (c.y + 0.5) * raster_.resolution_m}};
    settle(cell, here);
    for (const Cell next :
         {Cell{c.x, c.y - 1}, Cell{c.x - 1, c.y}, Cell{c.x + 1, c.y}, Cell{c.x, c.y + 1}}) {
      if (!raster_.contains(next)) continue;
      const auto other = static_cast<std::uint32_t>(raster_.indexOf(next));
      if (parents_[other] != kNone) join(cell, other, here);
    }
  }

  std::size_t left() const { return found_.size() - joined_; }
  std::vector<std::optional<Bottleneck>> take() { return std::move(found_); }

 private:
  std::uint32_t rootOf(std::uint32_t cell) {
    while (parents_[cell] != cell) {
      parents_[cell] = parents_[parents_[cell]];
      cell = parents_[cell];
    }
    return cell;
  }

  void join(std::uint32_t a, std::uint32_t b, const Bottleneck& here) {
    a = rootOf(a);
    b = rootOf(b);
    if (a == b) return;
    const auto of_a = ends_.find(a);
    const auto of_b = ends_.find(b);
    const std::size_t count_a = of_a == ends_.end() ? 0 : of_a->second.size();
    const std::size_t count_b = of_b == ends_.end() ? 0 : of_b->second.size();
    if (count_a < count_b) std::swap(a, b);
    parents_[b] = a;
    if (std::min(count_a, count_b) == 0) return;
    const std::vector<std::uint32_t> moved = std::move(ends_[b]);
    ends_.erase(b);
    std::vector<std::uint32_t>& all = ends_[a];
    all.insert(all.end(), moved.begin(), moved.end());
    settle(a, here);
  }

  /// Notes the pairs whose two ends are in one piece, and forgets them.
  void settle(std::uint32_t root, const Bottleneck& here) {
    const auto entry = ends_.find(root);
    if (entry == ends_.end()) return;
    std::vector<std::uint32_t>& ends = entry->second;
    std::sort(ends.begin(), ends.end());
    std::vector<std::uint32_t> rest;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if (i + 1 < ends.size() && ends[i] % 2 == 0 && ends[i + 1] == ends[i] + 1) {
        found_[ends[i] / 2] = here;
        ++joined_;
        ++i;
      } else {
        rest.push_back(ends[i]);
      }
    }
    ends = std::move(rest);
  }

  const ObstacleRaster& raster_;
  std::vector<std::uint32_t> parents_;
  std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> ends_;
  std::vector<std::optional<Bottleneck>> found_;
  std::size_t joined_ = 0;
};

std::uint32_t cellAt(const ObstacleRaster& raster, MapPoint p) {
  const double x = std::floor(p.x / raster.resolution_m);
  const double y = std::floor(p.y / raster.resolution_m);
  if (!(x >= 0 && y >= 0 && x < raster.width && y < raster.height)) return kNone;
  return static_cast<std::uint32_t>(
      raster.indexOf({static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)}));
}

/// Free cells, the widest first; what is `levels` or more is all the same.
std::vector<std::uint32_t> widestFirst(const std::vector<std::int32_t>& field,
                                       std::int32_t levels) {
  std::vector<std::uint32_t> begins(static_cast<std::size_t>(levels) + 2, 0);
  const auto slot = [&](std::int32_t value) {
    return static_cast<std::size_t>(levels - std::min(value, levels));
  };
  for (const std::int32_t value : field) ++begins[slot(value) + 1];
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  std::vector<std::uint32_t> order(begins[static_cast<std::size_t>(levels)]);
  for (std::uint32_t i = 0; i < field.size(); ++i) {
    if (field[i] > 0) order[begins[slot(field[i])]++] = i;
  }
  return order;
}

}  // namespace

std::vector<std::optional<Bottleneck>> findBottlenecks(
    const ObstacleRaster& raster, const std::vector<std::pair<MapPoint, MapPoint>>& pairs,
    double need_m, const Deadline& deadline) {
  const std::vector<std::int32_t> field = distanceField(raster, deadline);
  if (field.empty()) return {};
  const double twice = 2 * need_m / raster.resolution_m;
  const auto levels = static_cast<std::int32_t>(
      std::clamp(std::ceil(twice * twice - 1e-7), 1.0, double{kMostLevels}));
  Joining joining(raster, pairs.size());
  std::vector<std::uint32_t> ends;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::uint32_t from = cellAt(raster, pairs[i].first);
    const std::uint32_t to = cellAt(raster, pairs[i].second);
    if (from == kNone || to == kNone) continue;
    joining.addEnd(from, static_cast<std::uint32_t>(2 * i));
    joining.addEnd(to, static_cast<std::uint32_t>(2 * i + 1));
    ends.push_back(from);
    ends.push_back(to);
  }
  for (const std::uint32_t cell : ends) joining.open(cell, need_m);
  constexpr std::size_t kPoll = 1U << 16U;
  std::size_t done = 0;
  for (const std::uint32_t cell : widestFirst(field, levels)) {
    if (joining.left() == 0) break;
    if (++done % kPoll == 0 && deadline.expired()) return {};
    const double distance =
        field[cell] >= levels ? need_m : std::sqrt(field[cell]) / 2 * raster.resolution_m;
    joining.open(cell, distance);
  }
  return joining.take();
}

}  // namespace split_mapf
