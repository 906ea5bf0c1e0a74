#include "split_mapf/io/task_file.h"

#include <yaml-cpp/yaml.h>

#include <map>
#include <set>
#include <utility>

#include "io/file_bytes.h"
#include "io/line_reader.h"
#include "split_mapf/core/grid_parts.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

constexpr const char* kShape = "robots: [{start: [x, y], goals: [[x, y], ...]}, ...]";

class GoalListReader {
 public:
  GoalListReader(const std::string& path, const Grid& grid)
      : path_(path), grid_(grid), parts_(grid) {
    try {
      root_ = YAML::Load(readFile(path));
    } catch (const YAML::Exception& error) {
      failAt(error.mark, "read malformed YAML (" + error.msg + "), expected " + kShape);
    }
  }

  GoalLists read(std::optional<std::uint32_t> agents) {
    if (!root_.IsMap() || root_.size() != 1 || !root_["robots"]) {
      failAt(root_.Mark(), std::string("read something else, expected ") + kShape);
    }
    const YAML::Node list = root_["robots"];
    if (!list.IsSequence() || list.size() == 0) {
      failAt(list.Mark(), std::string("robots: read no robots, expected ") + kShape);
    }
    GoalLists lists;
    for (const YAML::Node& node : list) {
      if (agents && lists.starts.size() == *agents) return lists;
      readRobot(node, lists);
    }
    if (agents && lists.starts.size() < *agents) {
      failAt(list.Mark(), "robots: read " + counted(lists.starts.size(), "robot") + ", expected " +
                              counted(*agents, "robot"));
    }
    return lists;
  }

 private:
  [[noreturn]] void failAt(const YAML::Mark& mark, const std::string& message) const {
    failAtLine(path_, mark.line < 0 ? 1 : static_cast<std::size_t>(mark.line) + 1, message);
  }

  void readRobot(const YAML::Node& node, GoalLists& lists) {
    const std::string name = "robot " + std::to_string(lists.starts.size());
    if (!node.IsMap()) failAt(node.Mark(), name + ": read no robot, expected " + kShape);
    std::set<std::string> keys;
    for (const auto& pair : node) {
      const std::string key = pair.first.IsScalar() ? pair.first.Scalar() : "";
      if (!keys.insert(key).second) {
        failAt(pair.first.Mark(), name + ": read the key " + quote(key) + " twice");
      }
      if (key == "start" || key == "goals") continue;
      failAt(pair.first.Mark(),
             name + ": read the key " + quote(key) + ", expected start or goals");
    }
    if (!node["start"]) failAt(node.Mark(), name + ": start is missing, expected [x, y]");
    const Cell start = readCell(node["start"], name + ": start");
    const Vertex from = grid_.vertexAt(start);
    const auto [first, is_new] = starts_.emplace(from, lists.starts.size());
    if (!is_new) {
      failAt(node["start"].Mark(), name + ": start: read " + toString(start) + ", where robot " +
                                       std::to_string(first->second) +
                                       " starts, expected a cell of its own");
    }
    lists.starts.push_back(start);
    lists.goals.emplace_back();
    const YAML::Node goals = node["goals"];
    if (!goals) return;
    if (!goals.IsSequence()) {
      failAt(goals.Mark(), name + ": goals: read no list, expected [[x, y], ...]");
    }
    for (const YAML::Node& goal : goals) {
      const std::string what = name + ": goal " + std::to_string(lists.goals.back().size());
      const Cell cell = readCell(goal, what);
      if (parts_.partOf(grid_.vertexAt(cell)) != parts_.partOf(from)) {
        failAt(goal.Mark(), what + ": read " + toString(cell) +
                                ", which is cut off from its start " + toString(start) +
                                ", expected a cell that it can reach");
      }
      lists.goals.back().push_back(cell);
    }
  }

  Cell readCell(const YAML::Node& node, const std::string& what) const {
    Cell cell;
    if (!node.IsSequence() || node.size() != 2 || !readNumber(node[0], cell.x) ||
        !readNumber(node[1], cell.y)) {
      failAt(node.Mark(), what + ": read no cell, expected two whole numbers [x, y]");
    }
    if (!grid_.contains(cell)) {
      failAt(node.Mark(), what + ": read " + toString(cell) +
                              ", which is outside the map, expected " + "x below " +
                              std::to_string(grid_.width()) + " and y below " +
                              std::to_string(grid_.height()));
    }
    if (!grid_.isFree(cell)) {
      failAt(node.Mark(),
             what + ": read " + toString(cell) + ", which is blocked, expected a free cell");
    }
    return cell;
  }

  static bool readNumber(const YAML::Node& node, std::int32_t& number) {
    return node.IsScalar() && YAML::convert<std::int32_t>::decode(node, number);
  }

  const std::string& path_;
  const Grid& grid_;
  const GridParts parts_;
  YAML::Node root_;
  std::map<Vertex, std::size_t> starts_;  // and the robots that start there
};

/// Files of the League: a number, then so many rows.
class LeagueReader {
 public:
  LeagueReader(const std::string& path, const Grid& grid) : lines_(path), grid_(grid) {}

  std::uint64_t readCount(const char* what) {
    const std::string row = nextRow(what);
    const auto count = parseInteger(row);
    if (!count || *count < 1) lines_.fail(quote(row), what);
    return static_cast<std::uint64_t>(*count);
  }

  std::vector<Cell> readCells(const char* what) {
    const std::string row = nextRow(what);
    std::vector<Cell> cells;
    std::size_t begin = 0;
    for (;;) {
      const std::size_t comma = row.find(',', begin);
      cells.push_back(cellOf(row.substr(begin, comma - begin), what));
      if (comma == std::string::npos || comma + 1 == row.size()) return cells;
      begin = comma + 1;
    }
  }
  [[noreturn]] void fail(const std::string& read, const std::string& expected) const {
    lines_.fail(read, expected);
  }
  /// A row beyond the count would be left out without a word.
  void requireEnd(std::uint64_t count, const char* what) {
    for (auto row = lines_.nextFilled(); row; row = lines_.nextFilled()) {
      if (row->front() == '#') continue;
      lines_.fail(quote(*row),
                  "the end of the file: its first row announces " + counted(count, what));
    }
  }

 private:
  std::string nextRow(const char* what) {
    for (;;) {
      std::string row = lines_.requireFilled(what);
      if (row.front() != '#') return row;
    }
  }

  Cell cellOf(const std::string& text, const char* what) const {
    const auto number = parseInteger(text);
    if (!number) lines_.fail(quote(text), what);
    const std::int64_t width = grid_.width();
    if (*number < 0 || *number >= width * grid_.height()) {
      lines_.fail(quote(text),
                  "a cell of the map, below " + std::to_string(width * grid_.height()));
    }
    const Cell cell{static_cast<std::int32_t>(*number % width),
                    static_cast<std::int32_t>(*number / width)};
    if (!grid_.isFree(cell)) {
      lines_.fail(quote(text) + ", the blocked cell " + toString(cell), "a free cell");
    }
    return cell;
  }

  LineReader lines_;
  const Grid& grid_;
};

}  // namespace

GoalLists readGoalLists(const std::string& path, const Grid& grid,
                        std::optional<std::uint32_t> agents) {
  return GoalListReader(path, grid).read(agents);
}

std::vector<Cell> readLeagueAgents(const std::string& path, const Grid& grid,
                                   std::optional<std::uint32_t> agents) {
  LeagueReader reader(path, grid);
  const std::uint64_t count = reader.readCount("the number of robots");
  if (agents && *agents > count) {
    reader.fail(counted(count, "robot"), counted(*agents, "robot"));
  }
  std::vector<Cell> starts;
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> taken;
  while (starts.size() < (agents ? *agents : count)) {
    const std::vector<Cell> cells = reader.readCells("the cell of a robot");
    if (cells.size() != 1) reader.fail(counted(cells.size(), "cell"), "the cell of a robot");
    const auto [first, is_new] = taken.emplace(std::pair(cells[0].x, cells[0].y), starts.size());
    if (!is_new) {
      reader.fail(toString(cells[0]) + ", where robot " + std::to_string(first->second) + " starts",
                  "a cell of its own for robot " + std::to_string(starts.size()));
    }
    starts.push_back(cells[0]);
  }
  if (starts.size() == count) reader.requireEnd(count, "robot");
  return starts;
}

std::vector<std::vector<Cell>> readLeagueTasks(const std::string& path, const Grid& grid) {
  LeagueReader reader(path, grid);
  const std::uint64_t count = reader.readCount("the number of tasks");
  std::vector<std::vector<Cell>> tasks;
  while (tasks.size() < count) tasks.push_back(reader.readCells("the cells of a task"));
  reader.requireEnd(count, "task");
  return tasks;
}

}  // namespace split_mapf
