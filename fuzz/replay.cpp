// Gives every file of a corpus to the target that its folder is named after, without a fuzzer: what
// was once found stays found, with any compiler.
//
// usage: fuzz_replay CORPUS

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "targets.h"

namespace {

std::string bytesOf(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// How many files a target got; the name of one that it breaks on is printed.
int replay(const std::filesystem::path& folder, split_mapf::fuzz::Target target, int& broken) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    ++files;
    try {
      target(bytesOf(entry.path()));
    } catch (const std::exception& error) {
      std::printf("%s: %s\n", entry.path().c_str(), error.what());
      ++broken;
    }
  }
  return files;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::puts("usage: fuzz_replay CORPUS");
    return 1;
  }
  int broken = 0;
  for (const auto& [name, target] : split_mapf::fuzz::targets()) {
    const std::filesystem::path folder = std::filesystem::path(argv[1]) / name;
    const int files = std::filesystem::is_directory(folder) ? replay(folder, target, broken) : 0;
    std::printf("%s: %d files\n", name.c_str(), files);
    // A target without a corpus tests nothing.
    broken += files == 0 ? 1 : 0;
  }
  return broken == 0 ? 0 : 1;
}
