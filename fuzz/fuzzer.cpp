// One target for libFuzzer, which has the main(): its name is SPLIT_MAPF_FUZZ_TARGET.

#include <cstddef>
#include <cstdint>
#include <string>

#include "targets.h"

// libFuzzer looks for this name.
// NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const split_mapf::fuzz::Target target =
      split_mapf::fuzz::targets().at(SPLIT_MAPF_FUZZ_TARGET);
  target(std::string(data, data + size));
  return 0;
}
