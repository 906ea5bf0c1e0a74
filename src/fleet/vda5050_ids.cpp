#include "fleet/vda5050_ids.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace split_mapf {
namespace {

constexpr std::uint32_t kThousandths = 1000;

std::optional<std::uint32_t> numberOf(const std::string& digits) {
  constexpr std::size_t kMostDigits = 10;
  if (digits.empty() || digits.size() > kMostDigits ||
      digits.find_first_not_of("0123456789") != std::string::npos) {
    return std::nullopt;
  }
  const std::uint64_t number = std::stoull(digits);
  if (number > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  return static_cast<std::uint32_t>(number);
}

}  // namespace

std::string idOf(const std::string& plan, std::uint32_t number) {
  return plan + "/" + std::to_string(number);
}

std::optional<std::pair<std::string, std::uint32_t>> partsOf(const std::string& id) {
  const std::size_t slash = id.rfind('/');
  if (slash == std::string::npos) return std::nullopt;
  const auto number = numberOf(id.substr(slash + 1));
  if (!number) return std::nullopt;
  return std::make_pair(id.substr(0, slash), *number);
}

std::string nodeIdOf(const NodePlace& place) {
  const auto done = static_cast<std::uint32_t>(std::floor(place.fraction * kThousandths));
  const std::string id = idOf(place.plan, place.sequence);
  return done == 0 ? id : id + "@" + std::to_string(std::min(done, kThousandths - 1));
}

std::optional<NodePlace> placeOf(const std::string& node_id) {
  const std::size_t slash = node_id.rfind('/');
  const std::size_t sign = node_id.find('@', slash == std::string::npos ? 0 : slash);
  const auto visit = partsOf(node_id.substr(0, sign));
  if (!visit) return std::nullopt;
  NodePlace place{visit->first, visit->second, 0};
  if (sign == std::string::npos) return place;
  const auto done = numberOf(node_id.substr(sign + 1));
  if (!done || *done >= kThousandths) return std::nullopt;
  place.fraction = static_cast<double>(*done) / kThousandths;
  return place;
}

}  // namespace split_mapf
