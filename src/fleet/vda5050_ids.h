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

/// The place of a node: a visit, or `fraction` (below 1) of the move out of it, where a robot stood
/// when its order began.
struct NodePlace {
  std::string plan;
  std::uint32_t sequence = 0;
  double fraction = 0;
};

/// "PLAN/SEQUENCE", or "PLAN/SEQUENCE@THOUSANDTHS" on the way.
std::string nodeIdOf(const NodePlace& place);
/// Its place again, the fraction rounded down; nothing where somebody else named it.
std::optional<NodePlace> placeOf(const std::string& node_id);

}  // namespace split_mapf
