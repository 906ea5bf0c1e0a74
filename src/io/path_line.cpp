#include "io/path_line.h"

namespace split_mapf {
namespace {

Point centreOf(Cell cell) { return {cell.x + 0.5, cell.y + 0.5}; }

Point between(Point a, Point b, double share) {
  return {a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share};
}

// Whether the way from `a` to `c` is straight on through `b`.
bool goesStraight(Cell a, Cell b, Cell c) {
  return b.x - a.x == c.x - b.x && b.y - a.y == c.y - b.y;
}

bool turnsBack(Cell a, Cell b, Cell c) { return a == c && a != b; }

std::vector<Cell> withoutWaits(const std::vector<Cell>& path) {
  std::vector<Cell> cells;
  for (const Cell cell : path) {
    if (cells.empty() || cell != cells.back()) cells.push_back(cell);
  }
  return cells;
}

// A quarter turn from the middle of one move to the middle of the next.
void addRoundCorner(std::vector<Point>& course, Point a, Point b, Point c) {
  const Point first = between(a, b, 0.5);
  const Point last = between(b, c, 0.5);
  constexpr int kPieces = 5;
  for (int i = 0; i <= kPieces; ++i) {
    const double t = static_cast<double>(i) / kPieces;
    course.push_back(between(between(first, b, t), between(b, last, t), t));
  }
}

}  // namespace

std::vector<Point> courseOf(const std::vector<Cell>& path, Point lane) {
  const std::vector<Cell> cells = withoutWaits(path);
  const auto shifted = [lane](Cell cell) {
    const Point centre = centreOf(cell);
    return Point{centre.x + lane.x, centre.y + lane.y};
  };
  std::vector<Point> course = {centreOf(cells.front())};
  if (cells.size() == 1) return course;
  course.push_back(between(shifted(cells[0]), shifted(cells[1]), 0.5));
  for (std::size_t i = 1; i + 1 < cells.size(); ++i) {
    if (goesStraight(cells[i - 1], cells[i], cells[i + 1])) continue;
    if (turnsBack(cells[i - 1], cells[i], cells[i + 1])) {
      course.push_back(shifted(cells[i]));
    } else {
      addRoundCorner(course, shifted(cells[i - 1]), shifted(cells[i]), shifted(cells[i + 1]));
    }
  }
  course.push_back(between(shifted(cells[cells.size() - 2]), shifted(cells.back()), 0.5));
  course.push_back(centreOf(cells.back()));
  return course;
}

}  // namespace split_mapf
