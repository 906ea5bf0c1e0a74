#include "split_mapf/roadmap/distance_field.h"

#include <algorithm>

namespace split_mapf {
namespace {

/// Number of steps up or down to the nearest blocked cell of the same column, the rows beyond the
/// map being blocked.
void fillColumns(const ObstacleRaster& raster, std::vector<std::int32_t>& steps) {
  const std::size_t width = raster.width;
  const std::vector<std::int32_t> beyond(width, 0);
  const std::int32_t* above = beyond.data();
  for (std::size_t y = 0; y < raster.height; ++y) {
    std::int32_t* row = steps.data() + y * width;
    const std::uint8_t* blocked = raster.blocked.data() + y * width;
    for (std::size_t x = 0; x < width; ++x) row[x] = blocked[x] != 0 ? 0 : above[x] + 1;
    above = row;
  }
  const std::int32_t* below = beyond.data();
  for (std::size_t y = raster.height; y-- > 0;) {
    std::int32_t* row = steps.data() + y * width;
    for (std::size_t x = 0; x < width; ++x) row[x] = std::min(row[x], below[x] + 1);
    below = row;
  }
}

/// The lower envelope of parabolas over one row. Positions are doubled: a cell's centre lies at
/// 2x, the border between the columns x - 1 and x at 2x - 1.
class RowEnvelope {
 public:
  explicit RowEnvelope(std::uint32_t width)
      : width_(width), heights_(width), sites_(width + 1), begins_(width + 2) {}

  /// Turns a row of steps into a row of (2 * distance)^2.
  void run(std::int32_t* row) {
    for (std::uint32_t x = 0; x < width_; ++x) {
      const std::int32_t doubled = row[x] == 0 ? 0 : 2 * row[x] - 1;
      heights_[x] = doubled * doubled;
    }
    build();
    std::uint32_t site = 0;
    for (std::uint32_t x = 0; x < width_; ++x) {
      while (begins_[site + 1] <= static_cast<std::int32_t>(x)) ++site;
      const std::int64_t away = 2 * std::int64_t{x} - sites_[site].at;
      const std::int64_t far = away * away + sites_[site].height;
      row[x] = static_cast<std::int32_t>(std::min<std::int64_t>(far, heights_[x]));
    }
  }

 private:
  struct Site {
    std::int32_t at;
    std::int32_t height;
    double square;  // at^2 + height
  };

  /// A border is as near to an obstacle as the nearer of its two columns.
  Site siteAt(std::uint32_t border) const {
    const bool outer = border == 0 || border == width_;
    const std::int32_t height = outer ? 0 : std::min(heights_[border - 1], heights_[border]);
    const std::int32_t at = 2 * static_cast<std::int32_t>(border) - 1;
    return {at, height, static_cast<double>(at) * at + height};
  }

  void build() {
    sites_[0] = siteAt(0);
    begins_[0] = 0;
    std::uint32_t count = 1;
    for (std::uint32_t border = 1; border <= width_; ++border) {
      const Site site = siteAt(border);
      std::int32_t begin = beginOf(site, sites_[count - 1]);
      while (count > 1 && begin <= begins_[count - 1]) {
        --count;
        begin = beginOf(site, sites_[count - 1]);
      }
      if (begin >= static_cast<std::int32_t>(width_)) continue;
      if (begin <= begins_[count - 1]) --count;  // only the very first can be beaten everywhere
      begins_[count] = begin;
      sites_[count++] = site;
    }
    begins_[count] = static_cast<std::int32_t>(width_);
  }

  /// The first column whose centre is nearer to `right` than to `left`.
  static std::int32_t beginOf(const Site& right, const Site& left) {
    const double ahead = right.square - left.square;
    if (ahead < 0) return 0;
    return static_cast<std::int32_t>(ahead / (4.0 * (right.at - left.at))) + 1;
  }

  std::uint32_t width_;
  std::vector<std::int32_t> heights_;  // column -> (2 * distance up or down)^2
  std::vector<Site> sites_;            // of the envelope, from the left
  std::vector<std::int32_t> begins_;   // site -> the first column that it rules
};

}  // namespace

std::vector<std::int32_t> distanceField(const ObstacleRaster& raster, const Deadline& deadline) {
  std::vector<std::int32_t> field(raster.blocked.size());
  if (deadline.expired()) return {};
  fillColumns(raster, field);
  RowEnvelope envelope(raster.width);
  for (std::uint32_t y = 0; y < raster.height; ++y) {
    if (y % 64 == 0 && deadline.expired()) return {};
    envelope.run(field.data() + std::size_t{y} * raster.width);
  }
  return field;
}

}  // namespace split_mapf
