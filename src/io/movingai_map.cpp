#include <utility>

#include "io/file_bytes.h"
#include "io/line_reader.h"
#include "split_mapf/core/error.h"
#include "split_mapf/io/movingai.h"

namespace split_mapf {
namespace {

constexpr std::int64_t kMaxSide = 1 << 15;

// Reads "height 32" and its like.
std::uint32_t readSide(LineReader& reader, const std::string& name) {
  const std::string expected = "'" + name + " N' with N from 1 to " + std::to_string(kMaxSide);
  const std::string line = reader.require(expected);
  const std::vector<std::string> words = splitFields(line);
  const auto value = words.size() == 2 && words[0] == name ? parseInteger(words[1]) : std::nullopt;
  if (!value || *value < 1 || *value > kMaxSide) reader.fail(quoted(line), expected);
  return static_cast<std::uint32_t>(*value);
}

void readType(LineReader& reader) {
  const std::string expected = "'type octile'";
  const std::string line = reader.require(expected);
  if (splitFields(line) != std::vector<std::string>{"type", "octile"}) {
    reader.fail(quoted(line), expected);
  }
}

bool isFreeSymbol(LineReader& reader, char symbol, std::size_t column) {
  switch (symbol) {
    case '.':
    case 'G':
    case 'S':
      return true;
    case '@':
    case 'O':
    case 'T':
    case 'W':
      return false;
    default:
      reader.fail(quoted(std::string(1, symbol)) + " in column " + std::to_string(column + 1),
                  "one of '.GS' (free) or '@OTW' (blocked)");
  }
}

std::vector<bool> readCells(LineReader& reader, std::uint32_t width, std::uint32_t height) {
  std::vector<bool> free;
  for (std::uint32_t y = 0; y < height; ++y) {
    const std::string place = "row " + std::to_string(y + 1) + " of " + std::to_string(height);
    const std::string row = reader.require(place);
    if (row.size() != width) {
      reader.fail(std::to_string(row.size()) + " characters: " + quoted(row),
                  std::to_string(width) + " characters in " + place + ", the map's width");
    }
    for (std::size_t x = 0; x < row.size(); ++x) free.push_back(isFreeSymbol(reader, row[x], x));
  }
  return free;
}

}  // namespace

std::shared_ptr<const Grid> readMovingAiMap(const std::string& path) {
  LineReader reader(path);
  readType(reader);
  const std::uint32_t height = readSide(reader, "height");
  const std::uint32_t width = readSide(reader, "width");
  const std::string line = reader.require("'map'");
  if (splitFields(line) != std::vector<std::string>{"map"}) reader.fail(quoted(line), "'map'");
  const std::vector<bool> free = readCells(reader, width, height);
  if (!reader.onlyBlankLinesLeft()) {
    const std::string extra = *reader.next();
    reader.fail(quoted(extra), "the end of the file after " + std::to_string(height) + " rows");
  }
  return std::make_shared<Grid>(width, height, free);
}

void writeMovingAiMap(const std::string& path, const Grid& grid) {
  std::string text = "type octile\nheight " + std::to_string(grid.height()) + "\nwidth " +
                     std::to_string(grid.width()) + "\nmap\n";
  for (std::int32_t y = 0; y < static_cast<std::int32_t>(grid.height()); ++y) {
    for (std::int32_t x = 0; x < static_cast<std::int32_t>(grid.width()); ++x) {
      text += grid.isFree({x, y}) ? '.' : '@';
    }
    text += '\n';
  }
  writeFile(path, text);
}

}  // namespace split_mapf
