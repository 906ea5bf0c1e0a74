#include <algorithm>
#include <cstdlib>
#include <utility>

#include "core/detour_search.h"
#include "core/guided_search.h"

namespace split_mapf {
namespace {

// Sides, taken together, on which no distance with so few steps away outgrows 16 bits.
constexpr std::uint32_t kMostSides = 60000;
constexpr std::size_t kDirections = 4;
// Vertices around the goal that are searched from there.
constexpr std::size_t kAroundGoal = 200;

struct Choice {
  Cell cell;
  bool is_closer;
};

/// The moves towards a goal, in the order in which they are tried: along the longer side first, so
/// that a choice is left as long as possible.
Choice choiceOf(Cell at, Cell goal, std::uint32_t number) {
  const std::int32_t x = goal.x - at.x;
  const std::int32_t y = goal.y - at.y;
  const bool along_x = (std::abs(x) >= std::abs(y)) == (number % 2 == 0);
  const std::int32_t left = along_x ? x : y;
  const std::int32_t towards = left < 0 ? -1 : 1;
  const std::int32_t move = number < 2 ? towards : -towards;
  const Cell to = along_x ? Cell{at.x + move, at.y} : Cell{at.x, at.y + move};
  return {to, number < 2 && left != 0};
}

}  // namespace

bool DistanceTable::paysDetours(const DistanceGuide& guide) {
  return guide.may_complete && guide.known == nullptr && guide.grid->hasUnitMoves() &&
         guide.grid->width() + guide.grid->height() <= kMostSides;
}

void DistanceTable::startDetours(DistanceGuide guide) {
  detours_ = std::make_unique<DetourSearch>(std::move(guide), goal_);
  std::vector<Vertex> ring = {goal_};
  std::uint32_t distance = 0;
  for (std::size_t met = 0; met < kAroundGoal && !ring.empty(); met += ring.size()) {
    const std::vector<Vertex> inner = std::exchange(ring, {});
    ++distance;
    for (const Vertex v : inner) {
      for (const Vertex u : graph_->neighbours(v)) {
        if (isKnown(u)) continue;
        settle(u, distance);
        ring.push_back(u);
      }
    }
  }
  detours_->closeRing(ring, distance);
}

/// From now on as if there had been no detours.
void DistanceTable::leaveDetours() const {
  DistanceGuide guide = std::move(detours_->guide);
  detours_.reset();
  narrow_.assign(kPageSize, kNarrowUnknown);
  page_of_.assign(page_of_.size(), 0);
  settle(goal_, 0);
  guided_ = std::make_unique<GuidedSearch>(std::move(guide));
  guided_->length = guided_->bound(goal_);
  guided_->open.push_back(goal_);
}

std::size_t DistanceTable::bytesOfDetours() const {
  return sizeof *detours_ + detours_->least.capacity() +
         detours_->frames.capacity() * sizeof(DetourSearch::Frame);
}

std::uint8_t& DistanceTable::leastDetour(Vertex v) const {
  takePage(v);
  std::vector<std::uint8_t>& least = detours_->least;
  if (least.size() < narrow_.size()) least.resize(narrow_.size(), 0);
  return least[placeOf(v)];
}

std::uint32_t DistanceTable::searchDetours(Vertex v) const {
  DetourSearch& search = *detours_;
  const Cell cell = search.guide.grid->cellOf(v);
  const std::size_t worth_completing = graph_->size() / kShareWorthCompleting;
  // Only the first one tells what the map is like.
  const std::size_t most =
      search.expanded > 0 ? worth_completing
                          : kMostOfFirstDetours * search.rowsAndColumns(cell) + kMostBesidesDetours;
  while (!isKnown(v)) {
    if (search.expanded > worth_completing) {
      complete();
      return (*this)(v);
    }
    const std::uint8_t detour = std::max(leastDetour(v), search.floorOf(cell));
    if (detour > DetourSearch::kMostDetour || search.expanded > most) {
      leaveDetours();
      return (*this)(v);
    }
    search.frames.clear();
    search.frames.push_back({v, cell, 0});
    while (!search.frames.empty() && search.expanded <= most) tryNextMove();
  }
  return (*this)(v);
}

/// Of the last vertex of the way: goes on with it, or ends there.
void DistanceTable::tryNextMove() const {
  DetourSearch& search = *detours_;
  DetourSearch::Frame& frame = search.frames.back();
  const Vertex at = frame.vertex;
  const std::uint8_t detour = std::max(leastDetour(at), search.floorOf(frame.cell));
  const std::uint32_t distance = search.rowsAndColumns(frame.cell) + 2U * detour;
  if (frame.tried == 0) ++search.expanded;
  for (; frame.tried < kDirections; ++frame.tried) {
    const Choice choice = choiceOf(frame.cell, search.goal, frame.tried);
    if (!choice.is_closer && detour == 0) continue;
    const Vertex to = search.guide.grid->vertexAt(choice.cell);
    if (to == kNoVertex) continue;
    const std::uint16_t known = narrow_[placeOf(to)];
    if (known != kNarrowUnknown) {
      if (known + 1U != distance) continue;
      settle(at, distance);
      search.frames.pop_back();
      return;
    }
    // With less it is tried first, and this move again when that is known to fail.
    const std::uint8_t least = std::max(leastDetour(to), search.floorOf(choice.cell));
    if (least > (choice.is_closer ? detour : detour - 1)) continue;
    search.frames.push_back({to, choice.cell, 0});
    return;
  }
  leastDetour(at) = static_cast<std::uint8_t>(detour + 1);
  search.frames.pop_back();
}

}  // namespace split_mapf
