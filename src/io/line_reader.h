#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace split_mapf {

/// A text file, line by line, that knows where it is. Line ends are LF or CR LF and are cut off.
class LineReader {
 public:
  /// Reads the file. @throws InputError when that fails.
  explicit LineReader(std::string path);

  /// Moves to the next line and returns it; nothing at the end of the file.
  std::optional<std::string> next();
  /// The same where the file must not end. @param expected what should stand there.
  std::string require(const std::string& expected);
  /// Whether nothing but empty lines is left.
  bool onlyBlankLinesLeft() const;
  /// Number of the line that next() gave last; past the end, of the line that is missing.
  std::size_t line() const { return line_; }

  /// "path:line: read X, expected Y" at the present line.
  [[noreturn]] void fail(const std::string& read, const std::string& expected) const;
  /// "path:line: message" at the present line.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::string path_;
  std::string bytes_;
  std::size_t position_ = 0;
  std::size_t line_ = 0;
};

/// The integer that the whole text spells, if it does and fits.
std::optional<std::int64_t> parseInteger(const std::string& text);
/// The fields of a row: separated by single tabs, or by blanks where the row has no tab.
std::vector<std::string> splitFields(const std::string& row);

}  // namespace split_mapf
