#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace split_mapf {

/// JSON on one line, in ASCII: other characters are escaped, and bytes that are no UTF-8, which a
/// dump would throw for, become U+FFFD.
inline std::string asciiJson(const nlohmann::json& value) {
  return value.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

}  // namespace split_mapf
