#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace split_mapf {

/// A text file, line by line, that knows where it is. Line ends are LF or CR LF, or CR in a file
/// that has no LF; they are cut off, and so are blanks in front of them and a byte order mark.
class LineReader {
 public:
  /// Reads the file. @throws InputError when that fails.
  explicit LineReader(std::string path);

  /// Moves to the next line and returns it; nothing at the end of the file.
  std::optional<std::string> next();
  /// The same for the next line that is not empty.
  std::optional<std::string> nextFilled();
  /// The same where the file must not end. @param expected what should stand there.
  std::string requireFilled(const std::string& expected);
  /// Number of the line that was given last; past the end, of the line that is missing.
  std::size_t line() const { return line_; }

  /// "path:line: read X, expected Y" at the present line.
  [[noreturn]] void fail(const std::string& read, const std::string& expected) const;
  /// The same at an earlier line.
  [[noreturn]] void failAt(std::size_t line, const std::string& read,
                           const std::string& expected) const;
  /// "path:line: message" at the present line.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::string path_;
  std::string bytes_;
  char line_end_ = '\n';
  std::size_t position_ = 0;
  std::size_t line_ = 0;
};

/// The integer that the whole text spells, if it does and fits.
std::optional<std::int64_t> parseInteger(const std::string& text);
/// The words of a row, parted by blanks and tabs.
std::vector<std::string> splitWords(const std::string& row);
/// ASCII capitals made small; other bytes stay.
std::string lowerCase(std::string text);

}  // namespace split_mapf
