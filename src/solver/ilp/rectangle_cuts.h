#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "solver/ilp/conflict_row.h"
#include "solver/ilp/moves.h"
#include "split_mapf/core/instance.h"

namespace split_mapf::ilp {

/// Finds rectangle cuts. Two robots cross a rectangle, one from column to column and one from row
/// to row, both on time: at step s + |x - x0| + |y - y0| in cell (x, y). Two such ways share a
/// cell, and being on time, both robots are there at once. So of four events - one robot leaves the
/// first column, and enters the last; the other leaves the first row, and enters the last - at most
/// three happen, on time and within the rectangle. Source: Li et al., AAAI 2019; as a cut, Lam et
/// al., IJCAI 2019. Deviations: the events are the moves just inside the rectangle instead of those
/// across its border, which makes the same cut hold for a smaller rectangle.
class RectangleCuts {
 public:
  /// @pre both outlive this object.
  RectangleCuts(const Instance& instance, const MoveSpace& space)
      : grid_(instance.grid()), space_(space) {}

  /// Appends at most `most` violated cuts, the most violated first; none on a planning graph, whose
  /// moves skip columns and rows.
  void find(const std::vector<UsedPath>& used, std::size_t most, std::vector<ConflictRow>& rows);

 private:
  /// A move that is made to a degree, in the coordinates of its direction.
  struct Event {
    std::int32_t x = 0;  ///< of the cell that is entered
    std::int32_t y = 0;
    double value = 0;
  };
  /// How much enters one column, or one row, in all.
  struct Line {
    std::int32_t at = 0;
    double value = 0;
  };
  /// A robot's moves along one axis in one class of on-time cells.
  struct Track {
    std::vector<Event> events;
    std::vector<Line> lines;  ///< ascending
    double most = 0;          ///< of a line
  };
  struct Tracks {
    std::uint32_t robot = 0;
    Track across;  ///< along x
    Track down;    ///< along y
  };
  struct Crossing {
    std::int32_t first_x, last_x, first_y, last_y;
    std::uint32_t across, down;  ///< robots
    std::int32_t time;           ///< of cell (0, 0) in these coordinates
    int direction;
    double violation;
  };

  void collect(const std::vector<UsedPath>& used, int direction);
  static void note(std::int32_t line, const Event& event, Track& track);
  void search(int direction);
  void cross(const Tracks& a, const Tracks& b, std::int32_t time, int direction);
  ConflictRow toRow(const Crossing& crossing) const;
  void addMoves(std::uint32_t robot, const Crossing& c, bool across, std::int32_t line,
                ConflictRow& row) const;

  const Grid& grid_;
  const MoveSpace& space_;
  std::map<std::int32_t, std::vector<Tracks>> classes_;  // by the time of cell (0, 0)
  std::vector<Crossing> crossings_;
};

}  // namespace split_mapf::ilp
