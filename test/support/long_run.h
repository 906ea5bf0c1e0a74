#pragma once

#include <cstdlib>
#include <string>

namespace split_mapf::test {

/// Whether a random test is to run its long version, with many more cases than the usual run has
/// time for: the environment variable SPLIT_MAPF_LONG is 1 (cmake/soak_tests.cmake sets it).
inline bool isLongRun() {
  const char* wished = std::getenv("SPLIT_MAPF_LONG");
  return wished != nullptr && std::string(wished) == "1";
}

}  // namespace split_mapf::test
