#include "tool/league_result.h"

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf::tool {
namespace {

char letterOf(Cell from, Cell to) {
  if (to.x > from.x) return 'R';
  if (to.x < from.x) return 'L';
  if (to.y > from.y) return 'D';
  return to.y < from.y ? 'U' : 'W';
}

}  // namespace

bool asksForLeague(const CommandLine& line) {
  const std::string format = line.text("export", "");
  if (format.empty()) return false;
  if (format != "lorr") {
    throw OptionError("option --export: format " + quote(format) + " is unknown; lorr is expected");
  }
  if (!line.has("output")) {
    throw OptionError("option --export needs --output FILE: there is nowhere to write to");
  }
  return true;
}

std::string lettersOf(const std::vector<Cell>& path, std::size_t steps) {
  std::string letters;
  for (std::size_t t = 1; t <= steps; ++t) {
    if (t > 1) letters += ',';
    letters += t < path.size() ? letterOf(path[t - 1], path[t]) : 'W';
  }
  return letters;
}

}  // namespace split_mapf::tool
