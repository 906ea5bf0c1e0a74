#include <sstream>

#include "io/file_bytes.h"
#include "io/line_reader.h"
#include "split_mapf/core/distance_table.h"
#include "split_mapf/core/error.h"
#include "split_mapf/io/movingai.h"

namespace split_mapf {
namespace {

constexpr const char* kRowShape =
    "9 columns: bucket, map, width, height, start x, start y, goal x, goal y, length";

std::string sizeOf(std::int64_t width, std::int64_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

std::string sizeOf(const Grid& grid) { return sizeOf(grid.width(), grid.height()); }

// One file being read: where it stands, and the grid that its cells must fit.
class ScenarioReader {
 public:
  ScenarioReader(const std::string& path, const Grid& grid) : lines_(path), grid_(grid) {}

  Scenario read(std::optional<std::uint32_t> agents) {
    readVersion();
    Scenario scenario;
    while (!agents || scenario.starts.size() < *agents) {
      if (lines_.onlyBlankLinesLeft()) break;
      readRow(*lines_.next(), scenario);
    }
    requireRows(scenario.starts.size(), agents);
    return scenario;
  }

 private:
  void readVersion() {
    const std::string expected = "'version 1'";
    const std::string line = lines_.require(expected);
    const std::vector<std::string> words = splitFields(line);
    const bool known =
        words.size() == 2 && words[0] == "version" && (words[1] == "1" || words[1] == "1.0");
    if (!known) lines_.fail(quoted(line), expected);
  }

  void requireRows(std::size_t rows, std::optional<std::uint32_t> agents) {
    if (rows > 0 && (!agents || rows == *agents)) return;
    lines_.next();
    lines_.fail(
        "the end of the file after " + std::to_string(rows) + (rows == 1 ? " robot" : " robots"),
        agents ? std::to_string(*agents) + " robots" : "at least one");
  }

  void readRow(const std::string& row, Scenario& scenario) {
    const std::vector<std::string> fields = splitFields(row);
    if (fields.size() != 9) {
      lines_.fail(std::to_string(fields.size()) + " columns: " + quoted(row), kRowShape);
    }
    integerIn(fields[0], "bucket");
    const std::int64_t width = integerIn(fields[2], "width");
    const std::int64_t height = integerIn(fields[3], "height");
    if (width != grid_.width() || height != grid_.height()) {
      lines_.fail("a map of " + sizeOf(width, height), "the map's own size, " + sizeOf(grid_));
    }
    requireLength(fields[8]);
    const std::string robot = "robot " + std::to_string(scenario.starts.size()) + ": ";
    scenario.starts.push_back(freeCell(robot + "start ", fields[4], fields[5]));
    scenario.goals.push_back(freeCell(robot + "goal ", fields[6], fields[7]));
  }

  std::int64_t integerIn(const std::string& field, const std::string& column) {
    const auto value = parseInteger(field);
    if (!value) lines_.fail(quoted(field), "an integer as " + column);
    return *value;
  }

  void requireLength(const std::string& field) {
    double length = 0;
    std::istringstream in(field);
    in.imbue(std::locale::classic());
    if (!(in >> length) || in.peek() != std::istringstream::traits_type::eof()) {
      lines_.fail(quoted(field), "a number as length");
    }
  }

  Cell freeCell(const std::string& what, const std::string& x_field, const std::string& y_field) {
    const std::int64_t x = integerIn(x_field, what + "x");
    const std::int64_t y = integerIn(y_field, what + "y");
    const std::string named = what + "(" + std::to_string(x) + "," + std::to_string(y) + ")";
    if (x < 0 || y < 0 || x >= grid_.width() || y >= grid_.height()) {
      lines_.fail(named + " is outside the map, expected a free cell of the " + sizeOf(grid_) +
                  " map");
    }
    const Cell cell{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
    if (!grid_.isFree(cell)) lines_.fail(named + " is blocked, expected a free cell");
    return cell;
  }

  LineReader lines_;
  const Grid& grid_;
};

void requireFree(const Grid& grid, std::size_t robot, const std::string& what, Cell cell) {
  if (grid.isFree(cell)) return;
  throw InputError("robot " + std::to_string(robot) + ": " + what + " " + toString(cell) +
                   (grid.contains(cell) ? " is blocked" : " is outside the map") +
                   ", expected a free cell of the " + sizeOf(grid) + " grid");
}

}  // namespace

Scenario readMovingAiScenario(const std::string& path, const Grid& grid,
                              std::optional<std::uint32_t> agents) {
  if (agents && *agents == 0)
    throw InputError("0 robots asked of " + path + ", expected 1 or more");
  return ScenarioReader(path, grid).read(agents);
}

void writeMovingAiScenario(const std::string& path, const std::string& map_name, const Grid& grid,
                           const Scenario& scenario) {
  const std::size_t robots = scenario.starts.size();
  if (scenario.goals.size() != robots) {
    throw InputError("a scenario of " + std::to_string(robots) + " starts has " +
                     std::to_string(scenario.goals.size()) + " goals, expected as many");
  }
  std::ostringstream out;
  out.imbue(std::locale::classic());
  out << "version 1\n";
  for (std::size_t i = 0; i < robots; ++i) {
    const Cell start = scenario.starts[i];
    const Cell goal = scenario.goals[i];
    requireFree(grid, i, "start", start);
    requireFree(grid, i, "goal", goal);
    const DistanceTable distances(grid.graph(), grid.vertexAt(goal));
    const std::uint32_t length = distances(grid.vertexAt(start));
    const bool reachable = length != DistanceTable::kUnreachable;
    out << (reachable ? length / 4 : 0) << '\t' << map_name << '\t' << grid.width() << '\t'
        << grid.height() << '\t' << start.x << '\t' << start.y << '\t' << goal.x << '\t' << goal.y
        << '\t' << (reachable ? static_cast<std::int64_t>(length) : -1) << '\n';
  }
  writeFile(path, out.str());
}

}  // namespace split_mapf
