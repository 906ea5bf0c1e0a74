#include "support/ascii_grid.h"

#include <map>
#include <stdexcept>

namespace split_mapf::test {
namespace {

/// Where each letter stands; every character but '#' is free.
std::map<char, Cell> lettersOf(const std::vector<std::string>& rows) {
  std::map<char, Cell> letters;
  for (std::size_t y = 0; y < rows.size(); ++y) {
    for (std::size_t x = 0; x < rows[y].size(); ++x) {
      const char c = rows[y][x];
      if (c == '.' || c == '#') continue;
      const Cell cell = {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
      if (!letters.emplace(c, cell).second) {
        throw std::invalid_argument(std::string("letter drawn twice: ") + c);
      }
    }
  }
  return letters;
}

std::vector<std::string> withoutLetters(std::vector<std::string> rows) {
  for (std::string& row : rows) {
    for (char& c : row) {
      if (c >= 'a' && c <= 'z') c = '.';
    }
  }
  return rows;
}

}  // namespace

std::shared_ptr<const Grid> gridFromAscii(const std::vector<std::string>& rows) {
  std::vector<bool> free;
  for (const std::string& row : rows) {
    if (row.size() != rows.front().size()) throw std::invalid_argument("ragged picture");
    for (const char c : row) {
      if (c != '.' && c != '#') throw std::invalid_argument(std::string("not . or #: ") + c);
      free.push_back(c == '.');
    }
  }
  return std::make_shared<const Grid>(static_cast<std::uint32_t>(rows.front().size()),
                                      static_cast<std::uint32_t>(rows.size()), free);
}

Instance instanceFromAscii(const std::vector<std::string>& starts,
                           const std::vector<std::string>& goals) {
  const std::vector<std::string> walls = withoutLetters(starts);
  if (walls != withoutLetters(goals)) throw std::invalid_argument("the walls differ");
  const std::map<char, Cell> from = lettersOf(starts);
  const std::map<char, Cell> to = lettersOf(goals);
  std::vector<Cell> start_cells;
  std::vector<Cell> goal_cells;
  for (const auto& [letter, cell] : from) {
    if (to.count(letter) == 0) throw std::invalid_argument("the letters differ");
    start_cells.push_back(cell);
    goal_cells.push_back(to.at(letter));
  }
  if (to.size() != from.size()) throw std::invalid_argument("the letters differ");
  return Instance(gridFromAscii(walls), start_cells, goal_cells);
}

std::shared_ptr<const Grid> serpentineGrid(std::uint32_t side) {
  std::vector<bool> free(std::size_t{side} * side, true);
  for (std::uint32_t y = 1; y < side; y += 2) {
    const std::uint32_t gap = y % 4 == 1 ? side - 1 : 0;
    for (std::uint32_t x = 0; x < side; ++x) free[y * side + x] = x == gap;
  }
  // The last wall closes nothing off: no row lies below it.
  for (std::uint32_t x = 0; x < side; ++x) free[(side - 1) * side + x] = false;
  return std::make_shared<const Grid>(side, side, free);
}

}  // namespace split_mapf::test
