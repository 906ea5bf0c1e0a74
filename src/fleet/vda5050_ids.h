#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace split_mapf {

/// "PLAN/NUMBER": of an order the number among those of the plan, of a node the visit's.
std::string idOf(const std::string& plan, std::uint32_t number);
/// Plan and number again; nothing where somebody else named it.
std::optional<std::pair<std::string, std::uint32_t>> partsOf(const std::string& id);

}  // namespace split_mapf
