#pragma once

#include <map>
#include <string>
#include <vector>

namespace split_mapf {

/// Turns NAME=VALUE texts into a map. @param what  names the option in messages, e.g.
/// "--solver-option". @throws OptionError for a text without a name or '=', and for a name given
/// twice.
std::map<std::string, std::string> parseNamedValues(const std::vector<std::string>& texts,
                                                    const std::string& what);

}  // namespace split_mapf
