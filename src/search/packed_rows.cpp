#include "search/packed_rows.h"

#include <algorithm>
#include <cstring>

namespace split_mapf {
namespace {

// Small instances should not pay for much, large ones not for many allocations.
constexpr std::uint32_t kBlockBytes = 1U << 16;

template <typename Number>
void pack(const std::vector<std::uint32_t>& row, std::uint8_t* bytes) {
  for (const std::uint32_t value : row) {
    const auto number = static_cast<Number>(value);
    std::memcpy(bytes, &number, sizeof number);
    bytes += sizeof number;
  }
}

template <typename Number>
Number numberAt(const std::uint8_t* bytes, std::size_t i) {
  Number number;
  std::memcpy(&number, bytes + i * sizeof number, sizeof number);
  return number;
}

template <typename Number>
void unpack(const std::uint8_t* bytes, std::vector<std::uint32_t>& row) {
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = numberAt<Number>(bytes, i);
}

template <typename Number>
bool same(const std::uint8_t* bytes, const std::vector<std::uint32_t>& row) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (numberAt<Number>(bytes, i) != row[i]) return false;
  }
  return true;
}

}  // namespace

PackedRows::PackedRows(std::uint32_t columns, std::uint32_t largest)
    : columns_(columns),
      width_(largest <= 0xffffU ? 2 : 4),
      rows_a_block_(std::max<std::uint32_t>(1, kBlockBytes / (columns * width_))) {}

const std::uint8_t* PackedRows::at(std::uint32_t number) const {
  const std::size_t row = number % rows_a_block_;
  return blocks_[number / rows_a_block_].get() + row * columns_ * width_;
}

void PackedRows::append(const std::vector<std::uint32_t>& row) {
  if (size_ % rows_a_block_ == 0) {
    const std::size_t bytes = std::size_t{rows_a_block_} * columns_ * width_;
    blocks_.push_back(std::make_unique<std::uint8_t[]>(bytes));
  }
  const std::size_t offset = std::size_t{size_ % rows_a_block_} * columns_ * width_;
  std::uint8_t* const bytes = blocks_.back().get() + offset;
  ++size_;
  if (width_ == 2) return pack<std::uint16_t>(row, bytes);
  pack<std::uint32_t>(row, bytes);
}

void PackedRows::read(std::uint32_t number, std::vector<std::uint32_t>& row) const {
  row.resize(columns_);
  if (width_ == 2) return unpack<std::uint16_t>(at(number), row);
  unpack<std::uint32_t>(at(number), row);
}

bool PackedRows::equals(std::uint32_t number, const std::vector<std::uint32_t>& row) const {
  return width_ == 2 ? same<std::uint16_t>(at(number), row) : same<std::uint32_t>(at(number), row);
}

}  // namespace split_mapf
