#include "io/scenario_row.h"

#include <algorithm>
#include <iterator>

#include "io/line_reader.h"

namespace split_mapf {
namespace {

using Columns = std::vector<std::string>;

constexpr std::size_t kColumns = 9;

std::string withoutOuterBlanks(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
}

// What stands between tabs, empty where two stand together.
Columns splitAtTabs(const std::string& row) {
  Columns columns;
  std::size_t begin = 0;
  while (begin <= row.size()) {
    const std::size_t end = std::min(row.find('\t', begin), row.size());
    columns.push_back(withoutOuterBlanks(row.substr(begin, end - begin)));
    begin = end + 1;
  }
  return columns;
}

// Words of a row whose map has a name of several: they become one column.
Columns joinName(Columns words) {
  const auto name = words.begin() + 1;
  const auto behind = words.end() - (kColumns - 2);
  for (auto word = name + 1; word != behind; ++word) *name += " " + *word;
  words.erase(name + 1, behind);
  return words;
}

// Whether the columns behind the name, the length excepted, are whole numbers.
bool isNumeric(const Columns& columns) {
  return std::all_of(columns.begin() + 2, columns.begin() + kColumns - 1,
                     [](const std::string& column) { return parseInteger(column).has_value(); });
}

struct Split {
  Columns columns;
  bool gaps = false;  // whether two tabs stand together

  bool isRow() const {
    return columns.size() == kColumns || (columns.size() == kColumns - 1 && !gaps);
  }
};

Split split(const std::string& row) {
  const Columns parts = splitAtTabs(row);
  Split by_tabs;
  std::copy_if(parts.begin(), parts.end(), std::back_inserter(by_tabs.columns),
               [](const std::string& part) { return !part.empty(); });
  by_tabs.gaps = by_tabs.columns.size() < parts.size();
  if (by_tabs.isRow()) return by_tabs;
  Split by_blanks{splitWords(row), by_tabs.gaps};
  if (by_blanks.isRow()) return by_blanks;
  if (parts.size() > 1) return by_tabs;
  if (by_blanks.columns.size() > kColumns) {
    // A name that ends in a number would rather be a column too many at the end.
    const std::string& last_of_name = by_blanks.columns[by_blanks.columns.size() - kColumns + 1];
    Split joined{joinName(by_blanks.columns), false};
    if (!parseInteger(last_of_name) && isNumeric(joined.columns)) return joined;
  }
  return by_blanks;
}

}  // namespace

std::optional<ScenarioRow> splitScenarioRow(const std::string& row) {
  const Split found = split(row);
  if (!found.isRow()) return std::nullopt;
  const Columns& columns = found.columns;
  return ScenarioRow{columns[0], columns[1], columns[2],
                     columns[3], columns[4], columns[5],
                     columns[6], columns[7], columns.size() == kColumns ? columns[8] : ""};
}

bool isWholeScenarioRow(const std::string& row) {
  const Columns columns = split(row).columns;
  return columns.size() == kColumns && parseInteger(columns[0]) && isNumeric(columns);
}

std::size_t countColumns(const std::string& row) { return split(row).columns.size(); }

}  // namespace split_mapf
