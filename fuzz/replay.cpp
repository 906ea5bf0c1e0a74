// Gives every file of a corpus to the target that its folder is named after, without a fuzzer: what
// was once found stays found, with any compiler. A file whose name begins with sound_ must be
// taken: a reader that refuses everything finds nothing.
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

/// What is wrong with how a target goes about a file; empty: nothing.
std::string faultOf(const std::filesystem::path& file, split_mapf::fuzz::Target target,
                    bool is_sound) {
  try {
    return target(bytesOf(file)) || !is_sound ? "" : "is sound, but refused";
  } catch (const std::exception& error) {
    return error.what();
  }
}

struct Replayed {
  int files = 0;
  int sound = 0;
  int broken = 0;
};

/// Gives every file of the folder to the target; prints the name of each that it breaks on.
Replayed replay(const std::filesystem::path& folder, split_mapf::fuzz::Target target) {
  Replayed replayed;
  if (!std::filesystem::is_directory(folder)) return replayed;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const bool is_sound = entry.path().filename().string().rfind("sound_", 0) == 0;
    const std::string fault = faultOf(entry.path(), target, is_sound);
    if (!fault.empty()) std::printf("%s: %s\n", entry.path().c_str(), fault.c_str());
    ++replayed.files;
    replayed.sound += is_sound ? 1 : 0;
    replayed.broken += fault.empty() ? 0 : 1;
  }
  return replayed;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::puts("usage: fuzz_replay CORPUS");
    return 1;
  }
  int broken = 0;
  for (const auto& [name, target] : split_mapf::fuzz::targets()) {
    const Replayed replayed = replay(std::filesystem::path(argv[1]) / name, target);
    std::printf("%s: %d files, %d of them sound\n", name.c_str(), replayed.files, replayed.sound);
    // A target that never reads a sound file to its end tests little.
    broken += replayed.broken + (replayed.sound == 0 ? 1 : 0);
  }
  return broken == 0 ? 0 : 1;
}
