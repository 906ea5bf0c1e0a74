#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace split_mapf {

/// Reads NAME=VALUE option values by type. @throws OptionError naming the option, the value and
/// what was expected. Stateless, thread-safe.
class OptionValues {
 public:
  explicit OptionValues(const std::map<std::string, std::string>& values) : values_(values) {}

  std::string choice(const std::string& name, const std::string& fallback,
                     const std::vector<std::string>& choices) const;
  /// A whole number up to kMostCount, so that sums and products of a few do not overflow.
  static constexpr std::uint64_t kMostCount = 1000000000;
  std::uint64_t count(const std::string& name, std::uint64_t fallback) const;
  /// A finite number from `least` to `most`.
  double number(const std::string& name, double fallback, double least, double most) const;
  bool flag(const std::string& name, bool fallback) const;

 private:
  const std::map<std::string, std::string>& values_;
};

}  // namespace split_mapf
