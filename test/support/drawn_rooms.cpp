#include "support/drawn_rooms.h"

#include <vector>

#include "split_mapf/core/random.h"

namespace split_mapf::test {
namespace {

constexpr std::uint32_t kWall = 3;

/// Where walls begin, one more than there are rooms.
std::vector<std::uint32_t> drawWalls(RandomEngine& engine, std::uint32_t rooms,
                                     std::uint32_t side) {
  std::vector<std::uint32_t> walls = {0};
  for (std::uint32_t i = 0; i < rooms; ++i) {
    const auto length = static_cast<std::uint32_t>(side + drawBelow(engine, side));
    walls.push_back(walls.back() + kWall + length);
  }
  return walls;
}

/// Where a door begins between the walls `first` and `last`.
std::uint32_t drawDoor(RandomEngine& engine, std::uint32_t first, std::uint32_t last,
                       std::uint32_t door) {
  const std::uint32_t room = last - first - kWall;
  return first + kWall + door / 2 + static_cast<std::uint32_t>(drawBelow(engine, room - 2 * door));
}

}  // namespace

DrawnRooms drawRooms(std::uint64_t seed, std::uint32_t door, std::uint32_t side,
                     double resolution_m) {
  RandomEngine engine(seed);
  DrawnRooms drawn;
  drawn.columns = static_cast<std::uint32_t>(2 + drawBelow(engine, 3));
  drawn.rows = static_cast<std::uint32_t>(1 + drawBelow(engine, 3));
  const std::vector<std::uint32_t> xs = drawWalls(engine, drawn.columns, side);
  const std::vector<std::uint32_t> ys = drawWalls(engine, drawn.rows, side);
  const std::uint32_t width = xs.back() + kWall;
  const std::uint32_t height = ys.back() + kWall;
  std::vector<bool> free(std::size_t{width} * height, true);
  const auto fill = [&](std::uint32_t x, std::uint32_t y, std::uint32_t w, std::uint32_t h,
                        bool value) {
    for (std::uint32_t row = y; row < y + h; ++row) {
      for (std::uint32_t column = x; column < x + w; ++column) {
        free[std::size_t{row} * width + column] = value;
      }
    }
  };
  for (const std::uint32_t x : xs) fill(x, 0, kWall, height, false);
  for (const std::uint32_t y : ys) fill(0, y, width, kWall, false);
  for (std::uint32_t i = 0; i < drawn.columns; ++i) {
    for (std::uint32_t j = 0; j < drawn.rows; ++j) {
      if (i > 0) fill(xs[i], drawDoor(engine, ys[j], ys[j + 1], door), kWall, door, true);
      if (j > 0) fill(drawDoor(engine, xs[i], xs[i + 1], door), ys[j], door, kWall, true);
    }
  }
  drawn.raster = rasterOf(width, height, free, resolution_m);
  return drawn;
}

}  // namespace split_mapf::test
