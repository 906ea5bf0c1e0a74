#include "split_mapf/io/occupancy.h"

#include <string>

#include "split_mapf/core/error.h"

namespace split_mapf {

void requireRule(const OccupancyRule& rule) {
  if (rule.occupied_threshold < 1 || rule.occupied_threshold > 100) {
    throw OptionError("occupied_threshold is " + std::to_string(rule.occupied_threshold) +
                      ", expected 1 to 100 [%]");
  }
}

std::vector<bool> freeCells(const std::vector<std::int8_t>& values, const OccupancyRule& rule) {
  requireRule(rule);
  std::vector<bool> free(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) free[i] = isFreeOccupancy(values[i], rule);
  return free;
}

}  // namespace split_mapf
