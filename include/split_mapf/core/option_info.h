#pragma once

#include <string>

namespace split_mapf {

/// One option of a solver or a splitter, as `split_mapf solvers` lists it.
struct OptionInfo {
  std::string name;
  std::string default_value;
  std::string description;
};

}  // namespace split_mapf
