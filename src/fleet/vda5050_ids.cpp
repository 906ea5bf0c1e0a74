#include "fleet/vda5050_ids.h"

#include <limits>

namespace split_mapf {

std::string idOf(const std::string& plan, std::uint32_t number) {
  return plan + "/" + std::to_string(number);
}

std::optional<std::pair<std::string, std::uint32_t>> partsOf(const std::string& id) {
  const std::size_t slash = id.rfind('/');
  if (slash == std::string::npos) return std::nullopt;
  const std::string digits = id.substr(slash + 1);
  constexpr std::size_t kMostDigits = 10;
  if (digits.empty() || digits.size() > kMostDigits ||
      digits.find_first_not_of("0123456789") != std::string::npos) {
    return std::nullopt;
  }
  const std::uint64_t number = std::stoull(digits);
  if (number > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  return std::make_pair(id.substr(0, slash), static_cast<std::uint32_t>(number));
}

}  // namespace split_mapf
