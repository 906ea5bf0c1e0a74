#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace split_mapf {

/// Rows of equally many numbers, two bytes each where they fit, four otherwise. Rows never move and
/// are never taken out. Not thread-safe.
class PackedRows {
 public:
  /// @param largest  no number is greater.
  PackedRows(std::uint32_t columns, std::uint32_t largest);

  /// Keeps a row; its number is how many there were before. @pre row.size() == columns.
  void append(const std::vector<std::uint32_t>& row);
  void read(std::uint32_t number, std::vector<std::uint32_t>& row) const;
  bool equals(std::uint32_t number, const std::vector<std::uint32_t>& row) const;
  std::uint32_t size() const { return size_; }
  std::size_t bytes() const { return blocks_.size() * rows_a_block_ * columns_ * width_; }

 private:
  const std::uint8_t* at(std::uint32_t number) const;

  std::uint32_t columns_;
  std::uint32_t width_;  // bytes a number
  std::uint32_t rows_a_block_;
  std::uint32_t size_ = 0;
  std::vector<std::unique_ptr<std::uint8_t[]>> blocks_;
};

}  // namespace split_mapf
