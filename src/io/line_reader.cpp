#include "io/line_reader.h"

#include <charconv>
#include <sstream>
#include <utility>

#include "io/file_bytes.h"

namespace split_mapf {

LineReader::LineReader(std::string path) : path_(std::move(path)), bytes_(readFile(path_)) {}

std::optional<std::string> LineReader::next() {
  ++line_;
  if (position_ >= bytes_.size()) {
    return std::nullopt;
  }
  const std::size_t feed = bytes_.find('\n', position_);
  const std::size_t end = feed == std::string::npos ? bytes_.size() : feed;
  std::string line = bytes_.substr(position_, end - position_);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  position_ = end + 1;
  return line;
}

std::string LineReader::require(const std::string& expected) {
  std::optional<std::string> line = next();
  if (!line) fail("the end of the file", expected);
  return *std::move(line);
}

bool LineReader::onlyBlankLinesLeft() const {
  return position_ >= bytes_.size() ||
         bytes_.find_first_not_of(" \t\r\n", position_) == std::string::npos;
}

void LineReader::fail(const std::string& read, const std::string& expected) const {
  failAtLine(path_, line_, "read " + read + ", expected " + expected);
}

void LineReader::fail(const std::string& message) const { failAtLine(path_, line_, message); }

std::optional<std::int64_t> parseInteger(const std::string& text) {
  std::int64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

std::vector<std::string> splitFields(const std::string& row) {
  std::vector<std::string> fields;
  std::istringstream in(row);
  if (row.find('\t') == std::string::npos) {
    for (std::string field; in >> field;) fields.push_back(field);
  } else {
    for (std::string field; std::getline(in, field, '\t');) fields.push_back(field);
  }
  return fields;
}

}  // namespace split_mapf
