#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace split_mapf::test {

/// Path of a benchmark file, e.g. "movingai/den520d.map": below $SPLIT_MAPF_BENCHMARKS where that
/// is set, else below ../shared/benchmarks as seen from the package's root, where tests run.
/// Nothing when the file is not there; the test then skips and says so.
inline std::optional<std::string> benchmarkFile(const std::string& relative) {
  const char* folder = std::getenv("SPLIT_MAPF_BENCHMARKS");
  const std::filesystem::path root = folder != nullptr ? folder : "../shared/benchmarks";
  const std::filesystem::path file = root / relative;
  std::error_code unreadable;
  if (!std::filesystem::is_regular_file(file, unreadable)) return std::nullopt;
  return file.string();
}

/// What a test says that skips for want of such a file.
inline std::string benchmarkMissing(const std::string& relative) {
  return relative + " is neither below $SPLIT_MAPF_BENCHMARKS nor below ../shared/benchmarks";
}

}  // namespace split_mapf::test
