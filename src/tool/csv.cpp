#include "tool/csv.h"

#include <algorithm>

namespace split_mapf::tool {
namespace {

std::string csvField(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace

std::string csvRow(const std::vector<std::string>& fields) {
  std::string row;
  for (const std::string& field : fields) row += csvField(field) + ',';
  if (!row.empty()) row.pop_back();
  return row + '\n';
}

CsvRows readCsv(const std::string& text) {
  CsvRows read;
  CsvRows::Row row{{""}, 1};
  std::size_t line = 1;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\n') ++line;
    if (c == '"') {
      // Two inside of quotes stand for one: the first ends the quotes, the second begins them anew.
      if (!quoted && i > 0 && text[i - 1] == '"') row.fields.back() += c;
      quoted = !quoted;
    } else if (quoted || (c != ',' && c != '\n')) {
      row.fields.back() += c;
    } else if (c == ',') {
      row.fields.emplace_back();
    } else {
      read.rows.push_back(std::move(row));
      read.whole_bytes = i + 1;
      row = {{""}, line};
    }
  }
  return read;
}

}  // namespace split_mapf::tool
