#include "roadmap/local_ways.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>

namespace split_mapf::roadmap {
namespace {

constexpr std::uint32_t kFar = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint8_t kNoStep = 8;
// Straight steps at even places; 5 and 7 stand for 1 and the root of 2.
constexpr std::array<Cell, 8> kSteps = {
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
constexpr std::uint32_t kStraight = 5;
constexpr std::uint32_t kSlanted = 7;

}  // namespace

LocalWays::LocalWays(const ClearSpace& space)
    : space_(space),
      tight_(ClearSpace::fieldAt(1.15 * space.radius())),
      near_(ClearSpace::fieldAt(1.4 * space.radius())),
      roomy_(ClearSpace::fieldAt(1.8 * space.radius())),
      costs_(space.cells(), kFar),
      came_(space.cells(), kNoStep) {}

std::uint32_t LocalWays::weightOf(std::size_t cell) const {
  const std::int32_t field = space_.field(cell);
  if (field >= roomy_) return 1;
  if (field >= near_) return 2;
  return field >= tight_ ? 3 : 4;
}

void LocalWays::expand(const Open& from) {
  const Cell at = space_.raster().cellAt(from.cell);
  for (std::size_t s = 0; s < kSteps.size(); ++s) {
    const Cell step = kSteps[s];
    const Cell to{at.x + step.x, at.y + step.y};
    if (!space_.isClear(to)) continue;
    const bool slanted = step.x != 0 && step.y != 0;
    if (slanted && (!space_.isClear(Cell{to.x, at.y}) || !space_.isClear(Cell{at.x, to.y}))) {
      continue;
    }
    const auto cell = static_cast<std::uint32_t>(space_.raster().indexOf(to));
    const std::uint32_t cost = from.cost + weightOf(cell) * (slanted ? kSlanted : kStraight);
    if (cost >= costs_[cell]) continue;
    if (costs_[cell] == kFar) touched_.push_back(cell);
    costs_[cell] = cost;
    came_[cell] = static_cast<std::uint8_t>(s);
    open_.push_back({cost, cell});
    std::push_heap(open_.begin(), open_.end(), std::greater<>());
  }
}

std::vector<Cell> LocalWays::wayBack(std::uint32_t cell) const {
  std::vector<Cell> way;
  Cell at = space_.raster().cellAt(cell);
  for (;;) {
    way.push_back(at);
    const std::uint8_t step = came_[space_.raster().indexOf(at)];
    if (step == kNoStep) break;
    at = {at.x - kSteps[step].x, at.y - kSteps[step].y};
  }
  std::reverse(way.begin(), way.end());
  return way;
}

void LocalWays::reset() {
  for (const std::uint32_t cell : touched_) {
    costs_[cell] = kFar;
    came_[cell] = kNoStep;
  }
  touched_.clear();
  open_.clear();
}

std::optional<std::vector<Cell>> LocalWays::toMain(Cell from, const Draft& draft,
                                                   std::size_t most_cells) {
  const auto start = static_cast<std::uint32_t>(space_.raster().indexOf(from));
  costs_[start] = 0;
  touched_.push_back(start);
  open_.push_back({0, start});
  std::optional<std::vector<Cell>> way;
  while (!open_.empty() && touched_.size() <= most_cells) {
    std::pop_heap(open_.begin(), open_.end(), std::greater<>());
    const Open next = open_.back();
    open_.pop_back();
    if (next.cost > costs_[next.cell]) continue;
    const Cell at = space_.raster().cellAt(next.cell);
    bool arrived = false;
    draft.visitBox({at, at}, [&](std::uint32_t v) { arrived = arrived || draft.node(v).main; });
    if (arrived) {
      way = wayBack(next.cell);
      break;
    }
    expand(next);
  }
  reset();
  return way;
}

}  // namespace split_mapf::roadmap
