#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace split_mapf::tool {

/// A row of a CSV file (RFC 4180), with its line break. Fields may hold anything.
std::string csvRow(const std::vector<std::string>& fields);

/// What was read of a CSV file.
struct CsvRows {
  struct Row {
    std::vector<std::string> fields;
    std::size_t line = 0;  ///< of its first character, from 1
  };
  std::vector<Row> rows;
  /// Bytes of the whole rows. What is behind them is a row without its end.
  std::size_t whole_bytes = 0;
};

/// Reads what rows of csvRow() were written one behind another, the last perhaps not to its end.
CsvRows readCsv(const std::string& text);

}  // namespace split_mapf::tool
