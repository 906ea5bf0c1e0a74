#include "split_mapf/generate/generator.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "split_mapf/core/error.h"
#include "split_mapf/core/random.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kMaxSide = 1U << 15;
constexpr double kDefaultDensity = 0.1;

// A warehouse, in cells. Aisles are two wide, so that robots can pass each other.
constexpr std::uint32_t kAisle = 2;
constexpr std::uint32_t kShelfLength = 10;
constexpr std::uint32_t kShelfDepth = 2;
constexpr std::uint32_t kStationZone = 7;  // columns at the left and right edge without shelves
constexpr std::uint32_t kStationLength = 2;
constexpr std::uint32_t kStationDepth = 2;
constexpr std::uint32_t kStationPitch = 6;
constexpr std::uint32_t kWarehouseMinWidth = 2 * kStationZone + kShelfLength;
constexpr std::uint32_t kWarehouseMinHeight = 2 * kAisle + kShelfDepth + 2;

// Rooms, in cells. The pitch is the distance of two parallel walls.
constexpr std::uint32_t kRoomPitch = 16;
constexpr std::uint32_t kSmallRoomPitch = 8;
constexpr std::uint32_t kRoomsMinSide = 5;
constexpr std::uint32_t kDoorWidth = 2;

/// Free and blocked cells while a map is being drawn.
class DrawnMap {
 public:
  DrawnMap(std::uint32_t width, std::uint32_t height)
      : width_(width), free_(std::size_t{width} * height, true) {}
  void set(std::uint32_t x, std::uint32_t y, bool free) {
    free_[std::size_t{y} * width_ + x] = free;
  }
  void fill(std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height) {
    for (std::uint32_t row = y; row < y + height; ++row) {
      for (std::uint32_t column = x; column < x + width; ++column) set(column, row, false);
    }
  }
  const std::vector<bool>& free() const { return free_; }

 private:
  std::uint32_t width_;
  std::vector<bool> free_;
};

/// The smallest side a kind of map can have.
std::pair<std::uint32_t, std::uint32_t> smallestShape(MapKind kind) {
  switch (kind) {
    case MapKind::kRandom:
      return {1, 1};
    case MapKind::kWarehouse:
      return {kWarehouseMinWidth, kWarehouseMinHeight};
    case MapKind::kRooms:
      return {kRoomsMinSide, kRoomsMinSide};
  }
  return {1, 1};
}

void requireSide(const GeneratorOptions& options, const char* name, std::uint32_t side,
                 std::uint32_t smallest) {
  if (side >= smallest && side <= kMaxSide) return;
  throw OptionError(std::string(name) + " " + std::to_string(side) + ": a " +
                    toString(options.kind) + " map needs " + std::to_string(smallest) + " to " +
                    std::to_string(kMaxSide) + " cells");
}

void requireValid(const GeneratorOptions& options) {
  const auto [min_width, min_height] = smallestShape(options.kind);
  requireSide(options, "width", options.width, min_width);
  requireSide(options, "height", options.height, min_height);
  if (options.density && options.kind != MapKind::kRandom) {
    throw OptionError("density: only a random map has one, not a " + toString(options.kind) +
                      " map");
  }
  if (options.density && !(*options.density >= 0 && *options.density < 1)) {
    throw OptionError("density " + std::to_string(*options.density) +
                      ": expected a share of blocked cells, 0 <= density < 1");
  }
}

void strewObstacles(double density, RandomEngine& engine, std::uint32_t width, std::uint32_t height,
                    DrawnMap& map) {
  std::vector<std::uint32_t> cells(std::size_t{width} * height);
  for (std::uint32_t i = 0; i < cells.size(); ++i) cells[i] = i;
  shuffle(cells, engine);
  const auto blocked =
      static_cast<std::size_t>(std::floor(density * static_cast<double>(cells.size()) + 0.5));
  for (std::size_t i = 0; i < std::min(blocked, cells.size()); ++i) {
    map.set(cells[i] % width, cells[i] / width, false);
  }
}

void buildWarehouse(std::uint32_t width, std::uint32_t height, DrawnMap& map) {
  for (std::uint32_t y = kAisle; y + kShelfDepth + kAisle <= height; y += kShelfDepth + kAisle) {
    for (std::uint32_t x = kStationZone; x + kShelfLength + kStationZone <= width;
         x += kShelfLength + kAisle) {
      map.fill(x, y, kShelfLength, kShelfDepth);
    }
  }
  for (std::uint32_t y = kAisle; y + kStationLength + kAisle <= height; y += kStationPitch) {
    map.fill(0, y, kStationDepth, kStationLength);
    map.fill(width - kStationDepth, y, kStationDepth, kStationLength);
  }
}

/// Where the walls across a side stand, the outer ones included: evenly spread.
std::vector<std::uint32_t> placeWalls(std::uint32_t side) {
  const std::uint32_t pitch = side > 4 * kRoomPitch ? kRoomPitch : kSmallRoomPitch;
  const std::uint32_t rooms = std::max(1U, (side - 1) / pitch);
  std::vector<std::uint32_t> walls;
  for (std::uint32_t i = 0; i <= rooms; ++i) walls.push_back((side - 1) * i / rooms);
  return walls;
}

/// First cell of a door between two corners of a wall; the door is kDoorWidth wide.
std::uint32_t drawDoor(std::uint32_t corner, std::uint32_t next_corner, RandomEngine& engine) {
  const std::uint32_t inner = next_corner - corner - 1;
  return corner + 1 + static_cast<std::uint32_t>(drawBelow(engine, inner - kDoorWidth + 1));
}

void buildRooms(const GeneratorOptions& options, RandomEngine& engine, DrawnMap& map) {
  const std::vector<std::uint32_t> columns = placeWalls(options.width);
  const std::vector<std::uint32_t> rows = placeWalls(options.height);
  for (const std::uint32_t x : columns) map.fill(x, 0, 1, options.height);
  for (const std::uint32_t y : rows) map.fill(0, y, options.width, 1);
  for (std::size_t row = 0; row + 1 < rows.size(); ++row) {
    for (std::size_t column = 0; column + 1 < columns.size(); ++column) {
      const bool has_left = column > 0;
      const bool has_upper = row > 0;
      if (has_left) {
        const std::uint32_t door = drawDoor(rows[row], rows[row + 1], engine);
        for (std::uint32_t i = 0; i < kDoorWidth; ++i) map.set(columns[column], door + i, true);
      }
      if (has_upper) {
        const std::uint32_t door = drawDoor(columns[column], columns[column + 1], engine);
        for (std::uint32_t i = 0; i < kDoorWidth; ++i) map.set(door + i, rows[row], true);
      }
    }
  }
}

std::shared_ptr<const Grid> buildGrid(const GeneratorOptions& options, RandomEngine& engine) {
  DrawnMap map(options.width, options.height);
  switch (options.kind) {
    case MapKind::kRandom:
      strewObstacles(options.density.value_or(kDefaultDensity), engine, options.width,
                     options.height, map);
      break;
    case MapKind::kWarehouse:
      buildWarehouse(options.width, options.height, map);
      break;
    case MapKind::kRooms:
      buildRooms(options, engine, map);
      break;
  }
  return std::make_shared<const Grid>(options.width, options.height, map.free());
}

/// Vertices that can be reached from `from`; marks them in `seen`.
std::vector<Vertex> flood(const Graph& graph, Vertex from, std::vector<bool>& seen) {
  std::vector<Vertex> reached = {from};
  seen[from] = true;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    for (const Vertex v : graph.neighbours(reached[i])) {
      if (seen[v]) continue;
      seen[v] = true;
      reached.push_back(v);
    }
  }
  return reached;
}

/// The largest connected part in ascending order; of equally large ones the first.
std::vector<Vertex> largestComponent(const Graph& graph) {
  std::vector<bool> seen(graph.size(), false);
  std::vector<Vertex> largest;
  for (Vertex v = 0; v < graph.size(); ++v) {
    if (seen[v]) continue;
    std::vector<Vertex> component = flood(graph, v, seen);
    if (component.size() > largest.size()) largest = std::move(component);
  }
  std::sort(largest.begin(), largest.end());
  return largest;
}

std::vector<Cell> drawCells(const Grid& grid, std::vector<Vertex> vertices, std::uint32_t count,
                            RandomEngine& engine) {
  shuffle(vertices, engine);
  std::vector<Cell> cells;
  cells.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) cells.push_back(grid.cellOf(vertices[i]));
  return cells;
}

GeneratedProblem place(std::shared_ptr<const Grid> grid, std::uint32_t robots,
                       RandomEngine& engine) {
  if (robots == 0) throw OptionError("robots 0: at least one is needed");
  const std::vector<Vertex> component = largestComponent(grid->graph());
  if (robots > component.size()) {
    throw OptionError(counted(robots, "robot") + ": the largest connected part of this map has " +
                      counted(component.size(), "cell") +
                      ", and each robot needs its own start and goal");
  }
  GeneratedProblem problem;
  problem.starts = drawCells(*grid, component, robots, engine);
  problem.goals = drawCells(*grid, component, robots, engine);
  problem.grid = std::move(grid);
  return problem;
}

}  // namespace

std::string toString(MapKind kind) {
  switch (kind) {
    case MapKind::kRandom:
      return "random";
    case MapKind::kWarehouse:
      return "warehouse";
    case MapKind::kRooms:
      return "rooms";
  }
  throw std::logic_error("no such kind of map");
}

MapKind parseMapKind(const std::string& text) {
  for (const MapKind kind : {MapKind::kRandom, MapKind::kWarehouse, MapKind::kRooms}) {
    if (toString(kind) == text) return kind;
  }
  throw OptionError("type " + quote(text) + " is unknown; expected random, warehouse or rooms");
}

GeneratedProblem generateProblem(const GeneratorOptions& options) {
  requireValid(options);
  RandomEngine engine(options.seed);
  return place(buildGrid(options, engine), options.robots, engine);
}

GeneratedProblem drawRobots(std::shared_ptr<const Grid> grid, std::uint32_t robots,
                            std::uint64_t seed) {
  RandomEngine engine(seed);
  return place(std::move(grid), robots, engine);
}

}  // namespace split_mapf
