#include "solver/ilp/rectangle_cuts.h"

#include <algorithm>

namespace split_mapf::ilp {
namespace {

constexpr double kViolated = 3.02;
// A robot whose two events add up to less can hardly make a violated cut.
constexpr double kWeak = 1.02;

/// Directions mirror the grid so that both robots always go towards greater coordinates.
Cell mirrored(Cell cell, int direction) {
  return {(direction & 1) != 0 ? -cell.x : cell.x, (direction & 2) != 0 ? -cell.y : cell.y};
}

/// How much enters line `line`, with the other coordinate in [low, high].
template <typename Events, typename Line, typename Other>
double entering(const Events& events, std::int32_t line, std::int32_t low, std::int32_t high,
                Line line_of, Other other_of) {
  double sum = 0;
  for (const auto& event : events) {
    if (line_of(event) == line && low <= other_of(event) && other_of(event) <= high) {
      sum += event.value;
    }
  }
  return sum;
}

}  // namespace

void RectangleCuts::find(const std::vector<UsedPath>& used, std::size_t most,
                         std::vector<ConflictRow>& rows) {
  crossings_.clear();
  if (!grid_.hasUnitMoves()) return;  // no way is then known to cross every column of a rectangle
  for (int direction = 0; direction < 4; ++direction) {
    collect(used, direction);
    search(direction);
  }
  std::stable_sort(crossings_.begin(), crossings_.end(),
                   [](const Crossing& a, const Crossing& b) { return a.violation > b.violation; });
  if (crossings_.size() > most) crossings_.resize(most);
  for (const Crossing& crossing : crossings_) rows.push_back(toRow(crossing));
}

void RectangleCuts::collect(const std::vector<UsedPath>& used, int direction) {
  classes_.clear();
  for (const UsedPath& path : used) {
    for (std::uint32_t t = 0; t + 1 < path.path->size(); ++t) {
      const Cell from = mirrored(grid_.cellOf((*path.path)[t]), direction);
      const Cell to = mirrored(grid_.cellOf((*path.path)[t + 1]), direction);
      if (to.x < from.x || to.y < from.y || from == to) continue;
      const std::int32_t time = static_cast<std::int32_t>(t) - from.x - from.y;
      std::vector<Tracks>& robots = classes_[time];
      if (robots.empty() || robots.back().robot != path.robot)
        robots.push_back({path.robot, {}, {}});
      Tracks& tracks = robots.back();
      if (to.x > from.x) {
        note(to.x, {to.x, to.y, path.value}, tracks.across);
      } else {
        note(to.y, {to.x, to.y, path.value}, tracks.down);
      }
    }
  }
}

void RectangleCuts::note(std::int32_t line, const Event& event, Track& track) {
  const auto same = std::find_if(track.events.begin(), track.events.end(),
                                 [&](const Event& e) { return e.x == event.x && e.y == event.y; });
  if (same == track.events.end()) {
    track.events.push_back(event);
  } else {
    same->value += event.value;
  }
  const auto place = std::lower_bound(track.lines.begin(), track.lines.end(), line,
                                      [](const Line& l, std::int32_t at) { return l.at < at; });
  if (place == track.lines.end() || place->at != line) {
    track.most = std::max(track.most, track.lines.insert(place, {line, event.value})->value);
  } else {
    track.most = std::max(track.most, place->value += event.value);
  }
}

void RectangleCuts::search(int direction) {
  for (const auto& [time, robots] : classes_) {
    for (const Tracks& a : robots) {
      if (a.across.most < kWeak / 2) continue;
      for (const Tracks& b : robots) {
        if (a.robot == b.robot || 2 * (a.across.most + b.down.most) <= kViolated) continue;
        cross(a, b, time, direction);
      }
    }
  }
}

void RectangleCuts::cross(const Tracks& a, const Tracks& b, std::int32_t time, int direction) {
  const auto x_of = [](const Event& e) { return e.x; };
  const auto y_of = [](const Event& e) { return e.y; };
  Crossing best{};
  best.violation = kViolated;
  for (auto x1 = a.across.lines.begin(); x1 != a.across.lines.end(); ++x1) {
    for (auto x2 = x1; x2 != a.across.lines.end(); ++x2) {
      const double most = x1->value + x2->value;
      if (most + 2 * b.down.most <= best.violation) continue;
      for (auto y1 = b.down.lines.begin(); y1 != b.down.lines.end(); ++y1) {
        for (auto y2 = y1; y2 != b.down.lines.end(); ++y2) {
          if (most + y1->value + y2->value <= best.violation) continue;
          const std::vector<Event>& to_right = a.across.events;
          const std::vector<Event>& to_below = b.down.events;
          const double sum = entering(to_right, x1->at, y1->at - 1, y2->at, x_of, y_of) +
                             entering(to_right, x2->at, y1->at - 1, y2->at, x_of, y_of) +
                             entering(to_below, y1->at, x1->at - 1, x2->at, y_of, x_of) +
                             entering(to_below, y2->at, x1->at - 1, x2->at, y_of, x_of);
          if (sum <= best.violation) continue;
          best = {x1->at, x2->at, y1->at, y2->at, a.robot, b.robot, time, direction, sum};
        }
      }
    }
  }
  if (best.violation > kViolated) crossings_.push_back(best);
}

ConflictRow RectangleCuts::toRow(const Crossing& c) const {
  ConflictRow row;
  row.upper = 3;
  addMoves(c.across, c, true, c.first_x, row);
  addMoves(c.across, c, true, c.last_x, row);
  addMoves(c.down, c, false, c.first_y, row);
  addMoves(c.down, c, false, c.last_y, row);
  return row;
}

/// The on-time moves that enter a column (`across`) or a row of the rectangle from the one before.
void RectangleCuts::addMoves(std::uint32_t robot, const Crossing& c, bool across, std::int32_t line,
                             ConflictRow& row) const {
  const std::int32_t low = across ? c.first_y - 1 : c.first_x - 1;
  const std::int32_t high = across ? c.last_y : c.last_x;
  for (std::int32_t other = low; other <= high; ++other) {
    const Cell to = across ? Cell{line, other} : Cell{other, line};
    const Cell from = across ? Cell{line - 1, other} : Cell{other, line - 1};
    const std::int32_t step = c.time + from.x + from.y;
    if (step < 0 || step >= static_cast<std::int32_t>(space_.horizon())) continue;
    const Vertex v = grid_.vertexAt(mirrored(from, c.direction));
    const Vertex w = grid_.vertexAt(mirrored(to, c.direction));
    if (v == kNoVertex || w == kNoVertex) continue;
    row.terms.push_back({space_.move(static_cast<std::uint32_t>(step), v, w), robot});
  }
}

}  // namespace split_mapf::ilp
