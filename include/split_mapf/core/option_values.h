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
  std::uint64_t count(const std::string& name, std::uint64_t fallback) const;
  /// A finite number from `least` to `most`.
  double number(const std::string& name, double fallback, double least, double most) const;
  bool flag(const std::string& name, bool fallback) const;

 private:
  const std::map<std::string, std::string>& values_;
};

}  // namespace split_mapf
