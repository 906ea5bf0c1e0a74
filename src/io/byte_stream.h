#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace split_mapf {

/// Writes numbers in as few bytes as they need: seven bits a byte, the lowest first, the eighth
/// says that more follow.
class ByteWriter {
 public:
  void text(const std::string& bytes) { bytes_ += bytes; }
  void number(std::uint64_t value);
  /// How many bytes, then these.
  void sizedText(const std::string& bytes);
  /// How many there are, then each.
  void numbers(const std::vector<std::uint32_t>& values);
  /// Eight a byte, the lowest first.
  void bits(const std::vector<bool>& values);
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads what a ByteWriter wrote. Everything throws InputError with the byte's place where the
/// bytes end too soon or say what cannot be.
class ByteReader {
 public:
  /// @param what  is read, for messages. @pre the bytes outlive this object.
  ByteReader(const std::string& bytes, std::string what) : bytes_(bytes), what_(std::move(what)) {}

  void expectText(const std::string& text);
  /// @param name  for messages. @param most  greater ones are refused.
  std::uint32_t number(const std::string& name, std::uint32_t most = 0xffffffffU);
  /// One of up to 64 bits.
  std::uint64_t longNumber(const std::string& name);
  std::string sizedText(const std::string& name);
  std::vector<std::uint32_t> numbers(const std::string& name, std::uint32_t most);
  /// How many of something follow that takes a byte each at least.
  std::uint32_t count(const std::string& name);
  std::vector<bool> bits(std::size_t count);
  /// All that is left.
  std::string rest();
  /// Refuses what is left over.
  void expectEnd() const;
  [[noreturn]] void fail(const std::string& message) const;

 private:
  std::uint64_t read(const std::string& name, std::uint64_t most, unsigned most_bytes);
  std::size_t left() const { return bytes_.size() - at_; }

  const std::string& bytes_;
  std::string what_;
  std::size_t at_ = 0;
};

}  // namespace split_mapf
