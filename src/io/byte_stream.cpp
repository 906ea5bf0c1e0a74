#include "io/byte_stream.h"

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

constexpr unsigned kBitsAByte = 7;
constexpr std::uint8_t kMore = 0x80;

}  // namespace

void ByteWriter::number(std::uint64_t value) {
  for (; value >= kMore; value >>= kBitsAByte) {
    bytes_.push_back(static_cast<char>(static_cast<std::uint8_t>(value) | kMore));
  }
  bytes_.push_back(static_cast<char>(value));
}

void ByteWriter::sizedText(const std::string& bytes) {
  number(bytes.size());
  bytes_ += bytes;
}

void ByteWriter::numbers(const std::vector<std::uint32_t>& values) {
  number(values.size());
  for (const std::uint32_t value : values) number(value);
}

void ByteWriter::bits(const std::vector<bool>& values) {
  for (std::size_t i = 0; i < values.size(); i += 8) {
    unsigned byte = 0;
    for (std::size_t bit = 0; bit < 8 && i + bit < values.size(); ++bit) {
      byte |= values[i + bit] ? 1U << bit : 0U;
    }
    bytes_.push_back(static_cast<char>(byte));
  }
}

void ByteReader::fail(const std::string& message) const {
  throw InputError(what_ + ": byte " + std::to_string(at_) + ": " + message);
}

void ByteReader::expectText(const std::string& text) {
  if (bytes_.compare(at_, text.size(), text) != 0) fail(quote(text) + " is expected");
  at_ += text.size();
}

std::uint64_t ByteReader::read(const std::string& name, std::uint64_t most, unsigned most_bytes) {
  std::uint64_t value = 0;
  std::size_t next = at_;
  for (unsigned byte_of_number = 1;; ++byte_of_number, ++next) {
    if (next == bytes_.size()) fail("the bytes end where " + name + " is expected");
    const auto byte = static_cast<std::uint8_t>(bytes_[next]);
    value |= std::uint64_t{byte & (kMore - 1U)} << kBitsAByte * (byte_of_number - 1);
    if (value > most) {
      fail(name + " is " + std::to_string(value) + ", at most " + std::to_string(most) +
           " is expected");
    }
    if ((byte & kMore) == 0) break;
    if (byte_of_number == most_bytes) {
      fail(name + " takes more than " + std::to_string(most_bytes) + " bytes");
    }
  }
  at_ = next + 1;
  return value;
}

std::uint32_t ByteReader::number(const std::string& name, std::uint32_t most) {
  return static_cast<std::uint32_t>(read(name, most, 5));
}

std::uint64_t ByteReader::longNumber(const std::string& name) {
  return read(name, ~std::uint64_t{0}, 10);
}

std::string ByteReader::sizedText(const std::string& name) {
  const std::size_t size = count("the length of " + name);
  std::string text = bytes_.substr(at_, size);
  at_ += size;
  return text;
}

std::uint32_t ByteReader::count(const std::string& name) {
  const std::uint32_t count = number(name);
  if (count > left()) {
    fail(name + " is " + std::to_string(count) + ", but only " + counted(left(), "byte") +
         " follow");
  }
  return count;
}

std::vector<std::uint32_t> ByteReader::numbers(const std::string& name, std::uint32_t most) {
  std::vector<std::uint32_t> values(count("the number of " + name + "s"));
  for (std::uint32_t& value : values) value = number(name, most);
  return values;
}

std::vector<bool> ByteReader::bits(std::size_t count) {
  if ((count + 7) / 8 > left()) {
    fail(counted(count, "cell") + " are expected, but only " + counted(left(), "byte") + " follow");
  }
  std::vector<bool> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = (static_cast<std::uint8_t>(bytes_[at_ + i / 8]) >> i % 8 & 1U) != 0;
  }
  at_ += (count + 7) / 8;
  return values;
}

std::string ByteReader::rest() {
  std::string bytes = bytes_.substr(at_);
  at_ = bytes_.size();
  return bytes;
}

void ByteReader::expectEnd() const {
  if (left() > 0) fail(counted(left(), "byte") + " more than expected");
}

}  // namespace split_mapf
