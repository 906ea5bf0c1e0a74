#include "split_mapf/core/option_values.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include <boost/algorithm/string/join.hpp>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {

std::string OptionValues::choice(const std::string& name, const std::string& fallback,
                                 const std::vector<std::string>& choices) const {
  const auto found = values_.find(name);
  if (found == values_.end()) return fallback;
  if (std::find(choices.begin(), choices.end(), found->second) != choices.end()) {
    return found->second;
  }
  throw OptionError("option " + name + "=" + shown(found->second) + ": expected one of " +
                    boost::algorithm::join(choices, ", "));
}

std::uint64_t OptionValues::count(const std::string& name, std::uint64_t fallback) const {
  const auto found = values_.find(name);
  if (found == values_.end()) return fallback;
  const std::string& text = found->second;
  const bool digits = !text.empty() && text.size() < 19 &&
                      text.find_first_not_of("0123456789") == std::string::npos;
  if (digits && std::stoull(text) <= kMostCount) return std::stoull(text);
  throw OptionError("option " + name + "=" + shown(text) + ": expected a whole number from 0 to " +
                    std::to_string(kMostCount));
}

double OptionValues::number(const std::string& name, double fallback, double least,
                            double most) const {
  const auto found = values_.find(name);
  if (found == values_.end()) return fallback;
  const std::string& text = found->second;
  const bool plain =
      !text.empty() && text.find_first_not_of("0123456789.eE+-") == std::string::npos;
  char* stop = nullptr;
  const double value = plain ? std::strtod(text.c_str(), &stop) : 0;
  if (plain && *stop == '\0' && value >= least && value <= most) return value;
  std::ostringstream range;
  range << least << " to " << most;
  throw OptionError("option " + name + "=" + shown(text) + ": expected a number from " +
                    range.str());
}

bool OptionValues::flag(const std::string& name, bool fallback) const {
  return choice(name, fallback ? "true" : "false", {"true", "false"}) == "true";
}

}  // namespace split_mapf
