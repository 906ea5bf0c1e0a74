#pragma once

#include <algorithm>
#include <cstdlib>
#include <string>

namespace split_mapf::test {

/// Whether a random test is to run its long version, with many more cases than the usual run has
/// time for: the environment variable SPLIT_MAPF_LONG is 1 (cmake/soak_tests.cmake sets it).
inline bool isLongRun() {
  const char* wished = std::getenv("SPLIT_MAPF_LONG");
  return wished != nullptr && std::string(wished) == "1";
}

#ifdef SPLIT_MAPF_SANITIZED
inline constexpr bool kIsSanitized = true;
#else
inline constexpr bool kIsSanitized = false;
#endif

/// How many random cases a test draws: `usual`; in a long run `in_a_long_run` (0: no more than
/// usual); under a sanitizer a third of `usual`. There each case takes 5 to 20 times as long, and
/// faults of memory and threads, which a sanitizer looks for, repeat from case to case. Right
/// answers are the business of the plain run, which has them all. Least numbers that a test
/// expects of its cases are given the same way.
template <typename Count>
Count draws(Count usual, Count in_a_long_run = 0) {
  if (kIsSanitized) return std::max<Count>(1, usual / 3);
  return isLongRun() && in_a_long_run != 0 ? in_a_long_run : usual;
}

}  // namespace split_mapf::test
