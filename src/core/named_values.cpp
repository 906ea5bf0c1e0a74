#include "split_mapf/core/named_values.h"

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {

std::map<std::string, std::string> parseNamedValues(const std::vector<std::string>& texts,
                                                    const std::string& what) {
  std::map<std::string, std::string> values;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw OptionError(what + " " + quote(text) + ": expected NAME=VALUE");
    }
    const std::string name = text.substr(0, equals);
    if (!values.emplace(name, text.substr(equals + 1)).second) {
      throw OptionError(what + " " + quote(text) + ": " + shown(name) + " is given twice");
    }
  }
  return values;
}

}  // namespace split_mapf
