#include <string_view>
#include <utility>

#include "io/file_bytes.h"
#include "io/line_reader.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"
#include "split_mapf/io/movingai.h"

namespace split_mapf {
namespace {

constexpr std::int64_t kMaxSide = 1 << 15;
constexpr std::string_view kFreeSymbols = ".GSE";
constexpr std::string_view kBlockedSymbols = "@OTW";

std::string expectedSide(const std::string& name) {
  return "'" + name + " N' with N from 1 to " + std::to_string(kMaxSide);
}

bool isHeaderWord(const std::string& line) {
  const std::vector<std::string> words = splitWords(lowerCase(line));
  if (words.empty()) return false;
  return words[0] == "type" || words[0] == "height" || words[0] == "width" || words[0] == "map";
}

// One file being read: the header's lines in any order, then the rows.
class MapReader {
 public:
  explicit MapReader(const std::string& path) : lines_(path) {}

  std::shared_ptr<const Grid> read() {
    readHeader();
    const std::vector<bool> free = readCells();
    requireEnd();
    return std::make_shared<Grid>(width_, height_, free);
  }

 private:
  void readHeader() {
    for (;;) {
      const std::string expected = missingLine();
      const std::string line = lines_.requireFilled(expected);
      const std::vector<std::string> words = splitWords(lowerCase(line));
      if (words[0] == "map" && words.size() == 1 && height_ > 0 && width_ > 0) return;
      if (words[0] == "type") {
        readType(line, words);
      } else if (words[0] == "height") {
        readSide(line, words, height_);
      } else if (words[0] == "width") {
        readSide(line, words, width_);
      } else {
        lines_.fail(quote(line), expected);
      }
    }
  }

  // What the header still lacks, in the order in which most files have it.
  std::string missingLine() const {
    if (height_ == 0 && width_ == 0) {
      return typed_ ? expectedSide("height") : "'type octile' or " + expectedSide("height");
    }
    if (height_ == 0) return expectedSide("height");
    return width_ == 0 ? expectedSide("width") : "'map'";
  }

  void readType(const std::string& line, const std::vector<std::string>& words) {
    if (typed_) lines_.fail(quote(line) + " a second time", missingLine());
    // Rows of another type, hexagons for instance, look the same and mean something else.
    if (words != std::vector<std::string>{"type", "octile"}) {
      lines_.fail(quote(line), "'type octile'");
    }
    typed_ = true;
  }

  // Reads "height 32" and its like.
  void readSide(const std::string& line, const std::vector<std::string>& words,
                std::uint32_t& side) {
    if (side != 0) lines_.fail(quote(line) + " a second time", missingLine());
    const auto value = words.size() == 2 ? parseInteger(words[1]) : std::nullopt;
    if (!value || *value < 1 || *value > kMaxSide) {
      lines_.fail(quote(line), expectedSide(words[0]));
    }
    side = static_cast<std::uint32_t>(*value);
  }

  std::vector<bool> readCells() {
    std::vector<bool> free;
    for (std::uint32_t y = 0; y < height_; ++y) {
      const std::string place = "row " + std::to_string(y + 1) + " of " + std::to_string(height_);
      const std::string row = readRow(place);
      if (row.size() != width_) {
        lines_.fail(counted(row.size(), "character") + ": " + quote(row),
                    counted(width_, "character") + " in " + place + ", the map's width");
      }
      for (std::size_t x = 0; x < row.size(); ++x) free.push_back(isFreeSymbol(row[x], x));
    }
    return free;
  }

  // Empty lines between rows do no harm as long as no row is missing.
  std::string readRow(const std::string& place) {
    for (;;) {
      const std::optional<std::string> line = lines_.next();
      if (line && !line->empty()) return *line;
      if (!line && empty_line_ > 0) lines_.failAt(empty_line_, "an empty line", place);
      if (!line) lines_.fail("the end of the file", place);
      if (empty_line_ == 0) empty_line_ = lines_.line();
    }
  }

  bool isFreeSymbol(char symbol, std::size_t column) {
    if (kFreeSymbols.find(symbol) != std::string_view::npos) return true;
    if (kBlockedSymbols.find(symbol) != std::string_view::npos) return false;
    lines_.fail(quote(std::string(1, symbol)) + " in column " + std::to_string(column + 1),
                "one of '.GSE' (free) or '@OTW' (blocked)");
  }

  void requireEnd() {
    const std::optional<std::string> extra = lines_.nextFilled();
    if (!extra) return;
    const std::string end = "the end of the file after " + counted(height_, "row");
    if (isHeaderWord(*extra)) lines_.fail(quote(*extra) + ", a second map", end);
    lines_.fail(quote(*extra), end);
  }

  LineReader lines_;
  bool typed_ = false;
  std::uint32_t height_ = 0;
  std::uint32_t width_ = 0;
  std::size_t empty_line_ = 0;  // the first among the rows; 0: none
};

}  // namespace

std::shared_ptr<const Grid> readMovingAiMap(const std::string& path) {
  return MapReader(path).read();
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
