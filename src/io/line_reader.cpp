#include "io/line_reader.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "io/file_bytes.h"

namespace split_mapf {
namespace {

constexpr const char* kByteOrderMark = "\xef\xbb\xbf";
constexpr const char* kBlanks = " \t\r\v\f";

}  // namespace

LineReader::LineReader(std::string path) : path_(std::move(path)), bytes_(readFile(path_)) {
  if (bytes_.compare(0, 3, kByteOrderMark) == 0) position_ = 3;
  if (bytes_.find('\n') == std::string::npos) line_end_ = '\r';
}

std::optional<std::string> LineReader::next() {
  ++line_;
  if (position_ >= bytes_.size()) return std::nullopt;
  const std::size_t end = std::min(bytes_.find(line_end_, position_), bytes_.size());
  std::string line = bytes_.substr(position_, end - position_);
  line.erase(line.find_last_not_of(kBlanks) + 1);
  position_ = end + 1;
  return line;
}

std::optional<std::string> LineReader::nextFilled() {
  std::optional<std::string> line = next();
  while (line && line->empty()) line = next();
  return line;
}

std::string LineReader::requireFilled(const std::string& expected) {
  std::optional<std::string> line = nextFilled();
  if (!line) fail("the end of the file", expected);
  return *std::move(line);
}

void LineReader::fail(const std::string& read, const std::string& expected) const {
  failAt(line_, read, expected);
}

void LineReader::failAt(std::size_t line, const std::string& read,
                        const std::string& expected) const {
  failAtLine(path_, line, "read " + read + ", expected " + expected);
}

void LineReader::fail(const std::string& message) const { failAtLine(path_, line_, message); }

std::optional<std::int64_t> parseInteger(const std::string& text) {
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

std::vector<std::string> splitWords(const std::string& row) {
  std::vector<std::string> words;
  std::size_t begin = row.find_first_not_of(kBlanks);
  while (begin != std::string::npos) {
    const std::size_t end = std::min(row.find_first_of(kBlanks, begin), row.size());
    words.push_back(row.substr(begin, end - begin));
    begin = row.find_first_not_of(kBlanks, end);
  }
  return words;
}

std::string lowerCase(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

}  // namespace split_mapf
