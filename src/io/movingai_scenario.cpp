#include <sstream>

#include "io/file_bytes.h"
#include "io/line_reader.h"
#include "io/scenario_row.h"
#include "split_mapf/core/distance_table.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/io/movingai.h"
#include "split_mapf/io/pose_scenario.h"

namespace split_mapf {
namespace {

std::string sizeOf(std::int64_t width, std::int64_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

std::string sizeOf(MapSize size) { return sizeOf(size.width, size.height); }

// One file being read: where it stands, and the map that its cells must fit.
class ScenarioReader {
 public:
  ScenarioReader(const std::string& path, MapSize size, const Grid* grid)
      : lines_(path), size_(size), grid_(grid) {}

  Scenario read(std::optional<std::uint32_t> agents) {
    Scenario scenario;
    std::optional<std::string> row = firstRow();
    for (; row; row = lines_.nextFilled()) {
      readRow(*row, scenario);
      if (agents && scenario.starts.size() == *agents) return scenario;
    }
    requireRows(scenario.starts.size(), agents);
    return scenario;
  }

 private:
  // Behind the version, or the first line where there is none: a row that says the map's size can
  // be of no other version.
  std::optional<std::string> firstRow() {
    const std::string line = lines_.requireFilled("'version 1'");
    if (isWholeScenarioRow(line)) return line;
    const std::vector<std::string> words = splitWords(lowerCase(line));
    const bool known =
        words.size() == 2 && words[0] == "version" && (words[1] == "1" || words[1] == "1.0");
    if (!known) lines_.fail(quote(line), "'version 1'");
    return lines_.nextFilled();
  }

  void requireRows(std::size_t rows, std::optional<std::uint32_t> agents) {
    if (rows > 0 && !agents) return;
    lines_.fail("the end of the file after " + counted(rows, "robot"),
                agents ? counted(*agents, "robot") : "at least one");
  }

  void readRow(const std::string& line, Scenario& scenario) {
    const std::optional<ScenarioRow> row = splitScenarioRow(line);
    if (!row) {
      lines_.fail(counted(countColumns(line), "column") + ": " + quote(line), kScenarioRowShape);
    }
    integerIn(row->bucket, "bucket");
    const std::int64_t width = integerIn(row->width, "width");
    const std::int64_t height = integerIn(row->height, "height");
    if (width != size_.width || height != size_.height) {
      lines_.fail("a map of " + sizeOf(width, height), "the map's own size, " + sizeOf(size_));
    }
    requireLength(row->length);
    const std::string robot = "robot " + std::to_string(scenario.starts.size()) + ": ";
    scenario.starts.push_back(freeCell(robot + "start ", row->start_x, row->start_y));
    scenario.goals.push_back(freeCell(robot + "goal ", row->goal_x, row->goal_y));
  }

  std::int64_t integerIn(const std::string& field, const std::string& column) {
    const auto value = parseInteger(field);
    if (!value) lines_.fail(quote(field), "an integer as " + column);
    return *value;
  }

  // Nobody uses it, but a word there would mean that the columns are others.
  void requireLength(const std::string& field) {
    const std::string word = lowerCase(field);
    if (word.empty() || word == "inf" || word == "nan") return;
    double length = 0;
    std::istringstream in(field);
    in.imbue(std::locale::classic());
    if (!(in >> length) || in.peek() != std::istringstream::traits_type::eof()) {
      lines_.fail(quote(field), "a number as length");
    }
  }

  Cell freeCell(const std::string& what, const std::string& x_field, const std::string& y_field) {
    const std::int64_t x = integerIn(x_field, what + "x");
    const std::int64_t y = integerIn(y_field, what + "y");
    const std::string named = what + "(" + std::to_string(x) + "," + std::to_string(y) + ")";
    if (x < 0 || y < 0 || x >= size_.width || y >= size_.height) {
      lines_.fail(named + " is outside the map, expected a free cell of the " + sizeOf(size_) +
                  " map");
    }
    const Cell cell{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
    if (grid_ != nullptr && !grid_->isFree(cell))
      lines_.fail(named + " is blocked, expected a free cell");
    return cell;
  }

  LineReader lines_;
  MapSize size_;
  const Grid* grid_;  // null: which cells are free is not known
};

Scenario readScenario(const std::string& path, MapSize size, const Grid* grid,
                      std::optional<std::uint32_t> agents) {
  if (agents && *agents == 0) {
    throw InputError("0 robots asked of " + path + ", expected 1 or more");
  }
  if (isPoseScenario(path)) {
    throw InputError(path + ": holds poses of robots that have size, expected a MovingAI .scen");
  }
  return ScenarioReader(path, size, grid).read(agents);
}

void requireFree(const Grid& grid, std::size_t robot, const std::string& what, Cell cell) {
  if (grid.isFree(cell)) return;
  throw InputError("robot " + std::to_string(robot) + ": " + what + " " + toString(cell) +
                   (grid.contains(cell) ? " is blocked" : " is outside the map") +
                   ", expected a free cell of the " + sizeOf({grid.width(), grid.height()}) +
                   " grid");
}

}  // namespace

Scenario readMovingAiScenario(const std::string& path, const Grid& grid,
                              std::optional<std::uint32_t> agents) {
  return readScenario(path, {grid.width(), grid.height()}, &grid, agents);
}

Scenario readMovingAiScenario(const std::string& path, MapSize size,
                              std::optional<std::uint32_t> agents) {
  return readScenario(path, size, nullptr, agents);
}

void writeMovingAiScenario(const std::string& path, const std::string& map_name, const Grid& grid,
                           const Scenario& scenario) {
  const std::size_t robots = scenario.starts.size();
  if (scenario.goals.size() != robots) {
    throw InputError("a scenario of " + counted(robots, "start") + " has " +
                     counted(scenario.goals.size(), "goal") + ", expected as many");
  }
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << "version 1\n";
  for (std::size_t i = 0; i < robots; ++i) {
    const Cell start = scenario.starts[i];
    const Cell goal = scenario.goals[i];
    requireFree(grid, i, "start", start);
    requireFree(grid, i, "goal", goal);
    const Vertex from = grid.vertexAt(start);
    const DistanceTable distances(grid.vertexAt(goal), DistanceGuide{&grid, from, nullptr, true});
    const std::uint32_t length = distances(from);
    const bool reachable = length != DistanceTable::kUnreachable;
    out << (reachable ? length / 4 : 0) << '\t' << map_name << '\t' << grid.width() << '\t'
        << grid.height() << '\t' << start.x << '\t' << start.y << '\t' << goal.x << '\t' << goal.y
        << '\t' << (reachable ? static_cast<std::int64_t>(length) : -1) << '\n';
  }
  writeFile(path, wholeText(out));
}

}  // namespace split_mapf
